// Formats a run as a table for a terminal, as CSV and as JSON. Does not measure or write files.
#pragma once

#include <string>

#include "app/lab/bench/bench_run.h"

namespace gearshift::lab {

std::string bench_table(const BenchRun& run);
std::string bench_csv(const BenchRun& run);   // RFC 4180 except that lines end with LF; program and date on each line
std::string bench_json(const BenchRun& run);  // non-finite values are null

}  // namespace gearshift::lab
