// Writes the reproduction of the paper as one page: index.html next to its pictures.
#pragma once

#include <vector>

#include "app/lab/reproduce/section.h"

namespace gearshift::lab {

// Writes index.html to the study's folder. The page has no script and loads nothing from other sites. Throws FileError.
void write_page(const Study& study, const std::vector<Section>& sections);

}  // namespace gearshift::lab
