#include "haptics/files/range_check.h"

#include <charconv>
#include <cmath>
#include <stdexcept>

namespace gearshift::haptics {
namespace {

// Returns the shortest text that identifies the value, independent of the locale. Uses an exponent only for magnitudes
// below 1e-4 or from 1e15.
std::string format_number(double value) {
  const double size = std::abs(value);
  const bool is_plain = size == 0.0 || (size >= 1e-4 && size < 1e15);
  char digits[64];
  char* const end = digits + sizeof digits;
  const auto result =
      is_plain ? std::to_chars(digits, end, value, std::chars_format::fixed) : std::to_chars(digits, end, value);
  return {digits, result.ptr};
}

}  // namespace

double require_between(std::string_view name, double value, double low, double high, std::string_view unit) {
  if (value >= low && value <= high) return value;  // false for NaN
  std::string sentence = std::string(name) + " = " + format_number(value) + ": must be between " + format_number(low) +
                         " and " + format_number(high);
  if (!unit.empty()) sentence += ' ' + std::string(unit);
  throw std::invalid_argument(sentence);
}

}  // namespace gearshift::haptics
