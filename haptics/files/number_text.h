// Numbers as a person would write them in a sentence.
#pragma once

#include <string>

namespace gearshift {

// At most `decimals` digits after the point, without trailing zeros: 0.012 -> "0.012", 6.0 -> "6". What would
// read as zero and is not has an exponent. The same in any locale.
std::string number_text(double value, int decimals = 6);

// Metres as millimetres with one decimal: 0.0123 -> "12.3 mm".
std::string millimetres_text(double metres);

}  // namespace gearshift
