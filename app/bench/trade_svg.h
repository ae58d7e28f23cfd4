// Methods against each other: cost to the right, error upwards, both as powers of ten.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tests/bench/bench.h"

namespace gearshift {

// One picture of a family, a panel for each of its contests in the order of the rows: the front as a line, who is on it
// dark, who is beaten lighter, the shipped default ringed; below each panel who is who. What is not finite
// stands there alone. Empty where no row has a trade.
std::string trade_svg(std::string_view family, const std::vector<BenchRow>& rows);

}  // namespace gearshift
