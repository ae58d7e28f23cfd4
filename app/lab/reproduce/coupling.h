// Section 3 of the paper: coupling between the axes. With springs on both, pushes along one axis and measures the
// other.
#pragma once

#include "app/lab/reproduce/section.h"

namespace gearshift::lab {

void add_coupling(const Study& study, Section& section);

}  // namespace gearshift::lab
