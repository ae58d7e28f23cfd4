// Refusals in one sentence: what, its value, what is allowed.
#pragma once

#include <string>
#include <string_view>

namespace gearshift {

// The value, if low <= value <= high. If not, throws std::invalid_argument in the wording of a file's reader:
//     <name> = <value>: must be between <low> and <high> <unit>
double require_between(std::string_view name, double value, double low, double high, std::string_view unit = {});

}  // namespace gearshift
