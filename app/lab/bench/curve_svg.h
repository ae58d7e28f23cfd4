// Plots curves of rows, such as the stiffness of a wall in motion.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/lab/bench/rows/bench.h"

namespace gearshift::lab {

// Draws one picture per family: below each other the rows that have curves, each with its curves beside each other. Returns
// an empty text if no row has one.
std::string curve_svg(std::string_view family, const std::vector<BenchRow>& rows);

}  // namespace gearshift::lab
