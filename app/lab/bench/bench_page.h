// Formats a benchmark run as one self-contained HTML page.
#pragma once

#include <string>

#include "app/lab/bench/bench_run.h"

namespace gearshift::lab {

// The page is also well-formed XML, so that tests can check it with an XML parser.
std::string bench_page(const BenchRun& run);

}  // namespace gearshift::lab
