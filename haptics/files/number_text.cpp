#include "haptics/files/number_text.h"

#include <charconv>
#include <cmath>

namespace gearshift {
namespace {

constexpr double kLargestPlain = 1e15;  // beyond this, digits after the point mean nothing: use the exponent

std::string shortest(double value) {
  char digits[64];
  const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
  return {digits, end};
}

}  // namespace

std::string number_text(double value, int decimals) {
  if (!std::isfinite(value) || std::abs(value) >= kLargestPlain) return shortest(value);
  char digits[64];
  const auto end = std::to_chars(digits, digits + sizeof digits, value, std::chars_format::fixed, decimals).ptr;
  std::string text(digits, end);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  const bool zero = text == "0" || text == "-0";
  if (zero && value != 0.0) return shortest(value);
  return zero ? "0" : text;
}

std::string millimetres_text(double metres) {
  const double tenths = std::round(metres * 1e4);
  return number_text(tenths / 10.0, 1) + " mm";
}

}  // namespace gearshift
