// Section 3 of the paper: an emulated damper feels rougher than a spring. Compares both for slow and fast strokes, at
// 100 Hz and at the preset's rate.
#pragma once

#include "app/lab/reproduce/section.h"

namespace gearshift::lab {

void add_rough_damper(const Study& study, Section& section);

}  // namespace gearshift::lab
