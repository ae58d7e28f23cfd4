// Plots methods against each other: cost to the right, error upwards, both on logarithmic axes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/lab/bench/rows/bench.h"

namespace gearshift::lab {

// Draws one picture per family, with a panel per contest in the order of the rows. The Pareto front is a line; methods
// on it are dark, others lighter, and the shipped default is ringed. A list below each panel names the methods; methods
// with a non-finite value appear only there. Returns an empty text if no row has a trade (cost and error of a method).
std::string trade_svg(std::string_view family, const std::vector<BenchRow>& rows);

}  // namespace gearshift::lab
