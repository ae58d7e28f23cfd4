#include "app/vehicle/hand_guidance.h"

#include <algorithm>
#include <cmath>

#include "haptics/joystick/finite.h"

namespace gearshift::vehicle {
namespace {

using glm::dvec2;

struct Shape {
  double value = 0.0, slope = 0.0;
};

// Like |u|, but rounded off for |u| < width. There the slope is v (3 - v^2) / 2 with v = u / width, as in the gate's
// centring springs. For larger |u| the value is |u| - (0.375 width), so that it is continuous.
Shape rounded(double u, double width) noexcept {
  const double v = u / width;
  if (std::abs(v) >= 1.0) return {std::abs(u) - 0.375 * width, v < 0.0 ? -1.0 : 1.0};
  return {width * v * v * (0.75 - 0.125 * v * v), 0.5 * v * (3.0 - v * v)};
}

// Rises from 0 to 1 as u goes from 0 to width, with zero slope at both ends.
Shape rise(double u, double width) noexcept {
  const double v = std::clamp(u / width, 0.0, 1.0);
  return {v * v * (3.0 - 2.0 * v), 6.0 * v * (1.0 - v) / width};
}

// Distance [m] from the edge of this column of slots to the edge of the nearest other column.
double gap_next_to(const haptics::Gate& gate, const haptics::Column& column) noexcept {
  double gap = gate.select_max - gate.select_min;
  for (const haptics::Column& other : haptics::columns(gate)) {
    const double apart = std::abs(other.center - column.center) - other.half_width - column.half_width;
    if (apart > 0.0) gap = std::min(gap, apart);
  }
  return gap;
}

// Returns the guidance force divided by kGuidancePull [1].
dvec2 pull_to(const haptics::Gate& gate, const haptics::Slot& slot, dvec2 p) noexcept {
  const haptics::Column& goal = haptics::column_of(gate, slot.column);
  const haptics::Column& here = haptics::column_of(gate, haptics::nearest_column(gate, p.x));
  const double width = 2.0 * goal.half_width, soft = goal.half_width;
  const double side = static_cast<int>(slot.side);
  const double upward = p.y < 0.0 ? -1.0 : 1.0;

  const Shape across = rounded(p.x - goal.center, soft);
  const double held = rounded(here.center - goal.center, soft).value;
  const Shape fade = rise(std::abs(p.y) - gate.half_aisle, width);
  const double off = p.x - goal.center;
  const Shape away = rise(std::abs(off) - goal.half_width, gap_next_to(gate, goal));
  const double on_column = 1.0 - away.value, on_column_slope = -away.slope * (off < 0.0 ? -1.0 : 1.0);
  const Shape out = rounded(p.y, soft);
  const Shape in = rounded(p.y - side * slot.rest, soft);
  const double end_pull = in.value - slot.rest;  // <= out.value

  return {-across.slope * (1.0 - fade.value) - on_column_slope * (end_pull - out.value),
          fade.slope * upward * (across.value - held) - (1.0 - on_column) * out.slope - on_column * in.slope};
}

}  // namespace

dvec2 guidance_force(const haptics::Gate& gate, int gear, dvec2 proxy) noexcept {
  const int index = haptics::slot_of_gear(gate, gear);
  if (index == haptics::kNoSlot || !haptics::is_finite(proxy)) return {0.0, 0.0};
  return kGuidancePull * pull_to(gate, haptics::slot_of(gate, index), proxy);
}

dvec2 HandGuidance::step(const haptics::DriverControls& controls, dvec2 proxy, double period) noexcept {
  const bool same = controls.guided_gear == gear_;
  const double asked = same && controls.guidance > 0.0 ? std::min(controls.guidance, 1.0) : 0.0;
  const double max_step = kGuidanceRate * period;
  strength_ += std::clamp(asked - strength_, -max_step, max_step);
  if (strength_ == 0.0) gear_ = controls.guided_gear;
  return strength_ > 0.0 ? strength_ * guidance_force(gate_, gear_, proxy) : dvec2{0.0, 0.0};
}

}  // namespace gearshift::vehicle
