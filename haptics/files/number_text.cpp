#include "haptics/files/number_text.h"

#include <array>
#include <charconv>
#include <cmath>

namespace gearshift::haptics {
namespace {

constexpr double kMaxFixedPoint = 1e15;  // values of this size or more get an exponent; they have hardly any decimals

std::string shortest(double value) {
  char digits[64];
  const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
  return {digits, end};
}

}  // namespace

std::string number_text(double value, int decimals) {
  if (!std::isfinite(value) || std::abs(value) >= kMaxFixedPoint) return shortest(value);
  char digits[64];
  const auto end = std::to_chars(digits, digits + sizeof digits, value, std::chars_format::fixed, decimals).ptr;
  std::string text(digits, end);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  const bool is_zero = text == "0" || text == "-0";
  if (is_zero && value != 0.0) return shortest(value);
  return is_zero ? "0" : text;
}

std::string millimetres_text(double metres) {
  const double tenths = std::round(metres * 1e4);
  return number_text(tenths / 10.0, 1) + " mm";
}

std::string fixed_text(double value, int decimals) {
  std::array<char, 400> text;  // long enough: a double has at most 309 digits before the point
  const auto [end, error] = std::to_chars(text.begin(), text.end(), value, std::chars_format::fixed, decimals);
  return {text.begin(), end};
}

std::string short_text(double value) {
  std::array<char, 32> text;
  const auto [end, error] = std::to_chars(text.begin(), text.end(), value, std::chars_format::general, 6);
  return {text.begin(), end};
}

}  // namespace gearshift::haptics
