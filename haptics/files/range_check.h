// Range checks whose error message states name, value and allowed range.
#pragma once

#include <string>
#include <string_view>

namespace gearshift::haptics {

// Returns the value if low <= value <= high. Otherwise throws std::invalid_argument with the message
//     <name> = <value>: must be between <low> and <high> <unit>
// which the file readers use too.
double require_between(std::string_view name, double value, double low, double high, std::string_view unit = {});

}  // namespace gearshift::haptics
