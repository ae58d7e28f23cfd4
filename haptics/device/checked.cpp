#include "haptics/device/checked.h"

#include <charconv>
#include <cmath>
#include <stdexcept>

namespace gearshift {
namespace {

// As many digits as tell the value from any other, in any locale; an exponent only where zeros would be many.
std::string number(double value) {
  const double size = std::abs(value);
  const bool plain = size == 0.0 || (size >= 1e-4 && size < 1e15);
  char digits[64];
  char* const end = digits + sizeof digits;
  const auto result =
      plain ? std::to_chars(digits, end, value, std::chars_format::fixed) : std::to_chars(digits, end, value);
  return {digits, result.ptr};
}

}  // namespace

double require_between(std::string_view name, double value, double low, double high, std::string_view unit) {
  if (value >= low && value <= high) return value;  // false for not-a-number
  std::string sentence =
      std::string(name) + " = " + number(value) + ": must be between " + number(low) + " and " + number(high);
  if (!unit.empty()) sentence += ' ' + std::string(unit);
  throw std::invalid_argument(sentence);
}

}  // namespace gearshift
