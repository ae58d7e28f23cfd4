// A run as files: a table for a terminal, CSV, JSON. Nothing here measures or writes.
#pragma once

#include <string>

#include "app/bench/bench_run.h"

namespace gearshift {

std::string bench_table(const BenchRun& run);
std::string bench_csv(const BenchRun& run);   // a line a row; RFC 4180, but for the line ends; program and date on each
std::string bench_json(const BenchRun& run);  // what is not finite is null

}  // namespace gearshift
