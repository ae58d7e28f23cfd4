#include "app/lessons/simulated_driver/stroke_hand.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

#include "app/lessons/simulated_driver/driver_constants.h"
#include "haptics/loop/shift_script.h"

namespace gearshift::lessons {
namespace {

// Engineering values. kRelaxationTime is half of the value in ScriptedHand. With a longer time, the effort that pulls
// the lever out of a gear would push it on into the opposite slot.
constexpr double kEffortGain = 4000.0;       // [N/(m s)]
constexpr double kMaxPush = 30.0;            // [N] of the grip's spring and the effort: the motors can hold as much
constexpr double kArrivalTolerance = 0.001;  // [m]
constexpr double kRelaxationTime = 0.025;    // [s]
constexpr double kMaxCornerCut = 0.005;      // [m] the hand may cut a corner by this distance: half a slot's width

bool closes_after(const haptics::Gate& gate, int gear, int from) noexcept {
  return std::any_of(haptics::lockouts(gate).begin(), haptics::lockouts(gate).end(),
                     [&](const haptics::Lockout& lockout) {
                       return lockout.kind == haptics::LockoutKind::after_gear &&
                              lockout.slot == haptics::slot_of_gear(gate, gear) && lockout.after_gear == from;
                     });
}

}  // namespace

std::vector<haptics::HandStroke> strokes_to_gear(const haptics::Gate& gate, glm::dvec2 from, int engaged, int gear,
                                                 double pace) {
  haptics::ShiftStyle style;
  style.pace = pace;
  style.reaction = kStrokeDelay;
  if (haptics::is_sequential(gate)) style.engaged = engaged;
  std::vector<int> gears{gear};
  if (closes_after(gate, gear, engaged)) gears.insert(gears.begin(), haptics::kNeutralGear);
  return haptics::shift_strokes(gate, from, gears, style);
}

StrokeHand::StrokeHand(double period) noexcept : period_(period), effort_decay_(std::exp(-period / kRelaxationTime)) {}

void StrokeHand::start(std::vector<haptics::HandStroke> strokes, glm::dvec2 from, double time) {
  strokes_ = std::move(strokes);
  current_ = 0;
  from_ = from;
  begin_ = time;
  effort_ = {0.0, 0.0};
}

haptics::HandTarget StrokeHand::next(double time, glm::dvec2 lever) noexcept {
  haptics::HandTarget target;
  target.position = lever;
  target.push = lean_;
  if (strokes_.empty()) return target;
  const haptics::HandStroke& stroke = strokes_[current_];
  const double t = time - begin_;
  const bool arrived = t >= stroke.duration + stroke.dwell && glm::distance(lever, stroke.to) < kMaxCornerCut;
  if (arrived && !in_last_stroke()) {
    from_ = stroke.to;
    begin_ = time;
    ++current_;
    return next(time, lever);
  }
  target = haptics::minimum_jerk(from_, stroke.to, t, stroke.duration);
  target.pressed_down = stroke.pressed_down;
  target.lifted = stroke.lifted;
  target.push = stroke.push + effort(target.position - lever) + extra_;
  if (push_limit_ > 0.0) {
    target.position = lever;
    target.push = {0.0, std::copysign(push_limit_, stroke.to.y)};
  }
  return target;
}

bool StrokeHand::is_at_end(double time) const noexcept {
  return in_last_stroke() && time - begin_ >= strokes_.back().duration;
}

double StrokeHand::time_waiting(double time) const noexcept {
  if (strokes_.empty()) return 0.0;
  return std::max(0.0, time - begin_ - strokes_[current_].duration);
}

glm::dvec2 StrokeHand::effort(glm::dvec2 lag) noexcept {
  for (int axis = 0; axis < 2; ++axis) {
    const bool behind = std::abs(lag[axis]) > kArrivalTolerance;
    if (!behind || lag[axis] * effort_[axis] < 0.0) effort_[axis] *= effort_decay_;
    if (behind) effort_[axis] += kEffortGain * lag[axis] * period_;
    const double limit = std::max(0.0, kMaxPush - haptics::kGripHand.stiffness * std::abs(lag[axis]));
    effort_[axis] = std::clamp(effort_[axis], -limit, limit);
  }
  return effort_;
}

}  // namespace gearshift::lessons
