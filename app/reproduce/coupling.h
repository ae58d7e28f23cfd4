// Section 3: springs on both axes, pushed along one of them: what the other does.
#pragma once

#include "app/reproduce/section.h"

namespace gearshift {

void add_coupling(const Study& study, Section& section);

}  // namespace gearshift
