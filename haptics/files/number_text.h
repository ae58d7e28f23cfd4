// Numbers as text for messages.
#pragma once

#include <string>

namespace gearshift::haptics {

// Text of a number with at most `decimals` digits after the point and without trailing zeros: 0.012 -> "0.012", 6.0 ->
// "6". A nonzero value that would round to 0 is written with an exponent. Independent of the locale.
std::string number_text(double value, int decimals = 6);

std::string fixed_text(double value, int decimals);  // exactly `decimals` digits after the point: 0.3, 2 -> "0.30"
std::string short_text(double value);                // at most six significant digits: 3117.2 -> "3117.2"

// Converts metres to text in millimetres with one decimal: 0.0123 -> "12.3 mm".
std::string millimetres_text(double metres);

}  // namespace gearshift::haptics
