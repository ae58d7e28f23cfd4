// Compares the driveline with closed forms (lock-up time and slip energy of two inertias) and conservation laws.
#pragma once

#include <vector>

#include "app/lab/bench/rows/bench.h"

namespace gearshift::lab {

void add_closed_forms(std::vector<BenchRow>& rows);

}  // namespace gearshift::lab
