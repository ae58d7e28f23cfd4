// Formats a benchmark run as a table for a terminal, as CSV and as JSON.
#pragma once

#include <string>

#include "app/lab/bench/bench_run.h"

namespace gearshift::lab {

std::string bench_table(const BenchRun& run);
std::string bench_csv(const BenchRun& run);   // RFC 4180, but lines end with LF; every line contains program and date
std::string bench_json(const BenchRun& run);  // non-finite values become null

}  // namespace gearshift::lab
