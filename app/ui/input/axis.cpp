#include "app/ui/input/axis.h"

#include <algorithm>
#include <cmath>

#include "haptics/files/ascii.h"
#include "haptics/files/printable.h"

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

ControllerName name_of(const engine::Controller& controller) {
  const bool is_valid_in_file = !controller.name.empty() && haptics::printable(controller.name) == controller.name;
  return {is_valid_in_file ? controller.name : controller.guid, controller.id};
}

bool matches_stick(const engine::Controller& controller, std::string_view stick) {
  if (stick.empty()) return false;
  const std::string& name = controller.name;
  const auto at = std::search(name.begin(), name.end(), stick.begin(), stick.end(), same_letter);
  return at != name.end() || controller.id == stick || controller.guid == stick;
}

bool overlap(const AxisBinding& a, const AxisBinding& b) {
  if (a.of.stick != b.of.stick || a.which != b.which || a.axis != b.axis) return false;
  const auto start = [](const AxisBinding& axis) { return axis.from + axis.dead_zone * (axis.to - axis.from); };
  const auto [a_low, a_high] = std::minmax({start(a), a.to});
  const auto [b_low, b_high] = std::minmax({start(b), b.to});
  return a_low < b_high && b_low < a_high;
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
