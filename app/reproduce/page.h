// The reproduction as one page for people: index.html beside the pictures it shows.
#pragma once

#include <vector>

#include "app/reproduce/section.h"

namespace gearshift {

// Writes index.html into the study's folder. No script, nothing from outside the folder. Throws FileError.
void write_page(const Study& study, const std::vector<Section>& sections);

}  // namespace gearshift
