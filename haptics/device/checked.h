// Refusals in one sentence: what, its value, what is allowed.
#pragma once

#include <string>

namespace gearshift {

// Throws std::invalid_argument "<name> is <value>: allowed is <low> to <high> <unit>" unless low <= value <=
// high.
void require_between(const std::string& name, double value, double low, double high, const std::string& unit);

}  // namespace gearshift
