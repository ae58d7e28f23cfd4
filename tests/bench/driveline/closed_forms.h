// The driveline where mathematics alone has the answer: lock-up and slip energy of two inertias; what stays.
#pragma once

#include <vector>

#include "tests/bench/bench.h"

namespace gearshift {

void add_closed_forms(std::vector<BenchRow>& rows);

}  // namespace gearshift
