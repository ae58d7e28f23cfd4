// A row as JSON: in a run's file, and in what is kept for the next.
#pragma once

#include <nlohmann/json.hpp>

#include "tests/bench/bench.h"

namespace gearshift {

nlohmann::ordered_json row_json(const BenchRow& row);

}  // namespace gearshift
