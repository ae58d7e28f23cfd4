// Formats a row as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "app/lab/bench/rows/bench.h"

namespace gearshift::lab {

nlohmann::ordered_json row_json(const BenchRow& row);

}  // namespace gearshift::lab
