#include "app/ui/input/axis.h"

#include <algorithm>
#include <cmath>

#include "haptics/files/ascii.h"

namespace gearshift::ui {
namespace {

bool same_letter(char a, char b) {
  return haptics::ascii_lower(a) == haptics::ascii_lower(b);
}

// Rescales `value` (0 to 1) so that the range between dead zone and end zone becomes 0 to 1.
double between_zones(const AxisBinding& axis, double value) noexcept {
  return std::clamp((value - axis.dead_zone) / (1.0 - axis.dead_zone - axis.end_zone), 0.0, 1.0);
}

}  // namespace

bool matches_stick(const engine::PadState& stick, std::string_view name) {
  if (name.empty()) return stick.is_pad;
  const auto at = std::search(stick.name.begin(), stick.name.end(), name.begin(), name.end(), same_letter);
  return at != stick.name.end() || stick.guid == name;
}

const engine::PadState* find_stick(const std::vector<engine::PadState>& sticks, const AxisBinding& axis) {
  int before = axis.pad;
  for (const engine::PadState& stick : sticks)
    if (matches_stick(stick, axis.stick) && before-- == 0) return &stick;
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

}  // namespace gearshift::ui
