// Section 3: how rough an emulated damper is beside a spring, slow and fast, at 100 Hz and at the preset's rate.
#pragma once

#include "app/reproduce/section.h"

namespace gearshift {

void add_rough_damper(const Study& study, Section& section);

}  // namespace gearshift
