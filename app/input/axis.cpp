#include "app/input/axis.h"

#include <algorithm>
#include <cmath>

#include "haptics/files/ascii.h"

namespace gearshift {
namespace {

bool same_letter(char a, char b) {
  return ascii_lower(a) == ascii_lower(b);
}

// What is left of a value from 0 to 1 between the two zones, stretched to the whole again.
double between_zones(const AxisBinding& axis, double value) noexcept {
  return std::clamp((value - axis.dead_zone) / (1.0 - axis.dead_zone - axis.end_zone), 0.0, 1.0);
}

}  // namespace

bool is_meant(const PadState& stick, std::string_view name) {
  const auto at = std::search(stick.name.begin(), stick.name.end(), name.begin(), name.end(), same_letter);
  return name.empty() || at != stick.name.end() || stick.guid == name;
}

const PadState* find_stick(const std::vector<PadState>& sticks, const AxisBinding& axis) {
  int before = axis.pad;
  for (const PadState& stick : sticks)
    if (is_meant(stick, axis.stick) && before-- == 0) return &stick;
  return nullptr;
}

double centre_of(const AxisBinding& axis) noexcept {
  return axis.centre.value_or(0.5 * (axis.from + axis.to));
}

double lever_value(const AxisBinding& axis, double raw) noexcept {
  const double centre = centre_of(axis);
  const double right = (raw - centre) / (axis.to - centre), left = (raw - centre) / (axis.from - centre);
  return right > 0.0 ? between_zones(axis, right) : -between_zones(axis, left);
}

double pedal_value(const AxisBinding& axis, double raw) noexcept {
  return between_zones(axis, (raw - axis.from) / (axis.to - axis.from));
}

}  // namespace gearshift
