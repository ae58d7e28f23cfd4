// Plots methods against each other: cost to the right, error upwards, both on logarithmic axes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/lab/bench/rows/bench.h"

namespace gearshift::lab {

// One picture per family with a panel per contest, in the order of the rows: the Pareto front as a line, methods on it
// dark, others lighter, the shipped default ringed. A list below each panel names the methods; values that are not
// finite appear only there. Empty if no row has a trade.
std::string trade_svg(std::string_view family, const std::vector<BenchRow>& rows);

}  // namespace gearshift::lab
