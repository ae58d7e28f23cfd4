// Formats a run as one self-contained HTML page.
#pragma once

#include <string>

#include "app/lab/bench/bench_run.h"

namespace gearshift::lab {

// The page is also well-formed XML, so that an XML parser can check it.
std::string bench_page(const BenchRun& run);

}  // namespace gearshift::lab
