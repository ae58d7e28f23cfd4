#include "haptics/safety/force_guard.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

#include "haptics/joystick/finite.h"

namespace gearshift {
namespace {

using glm::dvec2;

constexpr std::int64_t kArmedPatience = 10;  // times stale_time: a device takes a while to say its first word

// After so long without a cycle in time (the process was stopped) the lever may be anywhere, and so may the hand: a force
// of before must not come back by itself. The stick's driver waits as long for an order.
constexpr double kMostLate = 0.1;  // [s]

constexpr std::int64_t kForever = 1'000'000'000'000;  // [cycles] a trace may say any number

std::int64_t sum(std::int64_t cycles, std::int64_t more) noexcept {
  return std::min(cycles + std::min(more, kForever), kForever);
}

}  // namespace

const char* guard_state_name(GuardState state) noexcept {
  static constexpr const char* kNames[] = {"idle", "armed", "ramping", "running", "damped", "released"};
  return kNames[static_cast<int>(state)];
}

const char* guard_fault_name(GuardFault fault) noexcept {
  static constexpr const char* kNames[] = {"none",         "stale reading", "overruns", "not finite",
                                           "limit broken", "stopped",       "chatter"};
  return kNames[static_cast<int>(fault)];
}

ForceGuard::ForceGuard(const GuardConfig& config, const DeviceSpec& spec, double period,
                       EnergyControl energy_control) noexcept
    : config_(config),
      max_force_(spec.max_force),
      position_limit_(spec.workspace + config.position_margin),
      period_(period),
      energy_control_(energy_control),
      bounder_{EnergyBounder(spec.axis_x, spec.delay, period), EnergyBounder(spec.axis_y, spec.delay, period)},
      controller_{PassivityController(spec.axis_x, period), PassivityController(spec.axis_y, period)},
      delay_(static_cast<std::size_t>(spec.delay)),
      stale_limit_(std::llround(config.stale_time / period)),
      late_limit_(spec.simulated ? kForever : std::llround(kMostLate / period)) {}

GuardOutput ForceGuard::guard(const GuardInput& in) noexcept {
  watch(in);
  const dvec2 travel = in.position - position_;
  position_ = in.position;
  const GuardOutput out = allowed(in, travel);
  newest_ = (newest_ + 1) % applied_.size();
  applied_[newest_] = out.force;
  return out;
}

GuardOutput ForceGuard::allowed(const GuardInput& in, dvec2 travel) noexcept {
  if (state_ == GuardState::idle || state_ == GuardState::released) {
    last_ = {0.0, 0.0};
    return {};
  }
  if (state_ == GuardState::damped) return {glm::clamp(damped_force(in), -max_force_, max_force_), false};
  const dvec2 wanted = controlled(in, travel);
  const dvec2 slewed = glm::clamp(wanted, last_ - config_.slew, last_ + config_.slew);
  last_ = glm::clamp(bounded(slewed, travel), -max_force_, max_force_);
  const bool saturated = std::abs(in.force.x) > max_force_.x || std::abs(in.force.y) > max_force_.y;
  const double share = ramp_gain();
  return {last_ * share, saturated, share};
}

// Looks for every fault before a force is let through. What is worse wins.
void ForceGuard::watch(const GuardInput& in) noexcept {
  const std::int64_t passed =
      stale_ > 0 ? sum(1, in.skipped) : 1;  // who reads had no turn, either: one cycle to catch up
  stale_ = in.fresh ? 0 : sum(stale_, passed);
  late_ = in.skipped > 0 ? sum(late_, in.skipped) : 0;
  overruns_ = in.skipped > 0 ? overruns_ + 1 : 0;
  const bool is_outside = std::abs(in.position.x) > position_limit_.x || std::abs(in.position.y) > position_limit_.y;
  if (!is_finite(in.force) || !is_finite(in.position) || !is_finite(in.velocity)) {
    return fall(GuardState::released, GuardFault::not_finite);
  }
  if (is_outside) return fall(GuardState::released, GuardFault::limit_broken);
  if (late_ > late_limit_) return fall(GuardState::released, GuardFault::overruns);
  const std::int64_t patience = state_ == GuardState::armed ? kArmedPatience * stale_limit_ : stale_limit_;
  if (stale_ > patience) return fall(GuardState::damped, GuardFault::stale_reading);
  if (overruns_ >= config_.overruns_in_row) return fall(GuardState::damped, GuardFault::overruns);
}

// Down the ladder only, and never out of idle.
void ForceGuard::fall(GuardState state, GuardFault fault) noexcept {
  if (state_ == GuardState::idle || state <= state_) return;
  state_ = state;
  fault_ = fault;
  fade_from_ = last_ * ramp_;
  fade_ = 1.0;
  ramp_ = 0.0;
}

// Counted against the command that acted over `travel`.
dvec2 ForceGuard::controlled(const GuardInput& in, dvec2 travel) noexcept {
  if (energy_control_ != EnergyControl::passivity_controller) return in.force;
  const dvec2 acted = applied_[(newest_ + applied_.size() - delay_) % applied_.size()];
  dvec2 force = in.force;
  for (int i = 0; i < 2; ++i)
    force[i] = controller_[static_cast<std::size_t>(i)].control(force[i], acted[i], travel[i], in.touches);
  return force;
}

// Against the newest command, whose effect is still to come. After the slew: a force that has to go may go at once.
dvec2 ForceGuard::bounded(dvec2 force, dvec2 travel) const noexcept {
  if (energy_control_ != EnergyControl::energy_bounding) return force;
  for (int i = 0; i < 2; ++i)
    force[i] = bounder_[static_cast<std::size_t>(i)].bound(force[i], applied_[newest_][i], travel[i]);
  return force;
}

// The last force dies away within fade_time; while readings are fresh, damping is left.
dvec2 ForceGuard::damped_force(const GuardInput& in) noexcept {
  fade_ = std::max(0.0, fade_ - period_ / config_.fade_time);
  const dvec2 damping = in.fresh ? -config_.damped_damping * in.velocity : dvec2{0.0, 0.0};
  return fade_ * fade_from_ + damping;
}

double ForceGuard::ramp_gain() noexcept {
  if (state_ == GuardState::armed && stale_ == 0) state_ = GuardState::ramping;
  if (state_ != GuardState::ramping) return state_ == GuardState::armed ? 0.0 : ramp_;
  ramp_ = std::min(1.0, ramp_ + period_ / config_.ramp_time);
  if (ramp_ == 1.0) state_ = GuardState::running;
  return ramp_;
}

bool ForceGuard::arm() noexcept {
  if (state_ == GuardState::armed || state_ == GuardState::ramping || state_ == GuardState::running) return false;
  state_ = GuardState::armed;
  fault_ = GuardFault::none;
  last_ = {0.0, 0.0};
  ramp_ = 0.0;
  stale_ = 0;
  late_ = 0;
  overruns_ = 0;
  applied_.fill({0.0, 0.0});
  for (PassivityController& controller : controller_) controller.reset();
  return true;
}

void ForceGuard::refuse() noexcept {
  fault_ = GuardFault::stopped;
}

void ForceGuard::disarm() noexcept {
  state_ = GuardState::idle;
  last_ = {0.0, 0.0};
  ramp_ = 0.0;
}

void ForceGuard::damp() noexcept {
  fall(GuardState::damped, GuardFault::chatter);
}

void ForceGuard::stop() noexcept {
  if (state_ != GuardState::idle) fall(GuardState::released, GuardFault::stopped);
}

}  // namespace gearshift
