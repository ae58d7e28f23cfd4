// A run as one page that needs nothing beside it.
#pragma once

#include <string>

#include "app/bench/bench_run.h"

namespace gearshift {

// Well-formed XML too: a reader of that kind can check it.
std::string bench_page(const BenchRun& run);

}  // namespace gearshift
