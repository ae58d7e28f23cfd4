// Section 3 of the paper: coupling between the axes. Both axes have a spring; a push along one axis also moves the
// other.
#pragma once

#include "app/lab/reproduce/section.h"

namespace gearshift::lab {

void add_coupling(const Study& study, Section& section);

}  // namespace gearshift::lab
