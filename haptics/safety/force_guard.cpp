#include "haptics/safety/force_guard.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include "haptics/joystick/finite.h"

namespace gearshift::haptics {
namespace {

using glm::dvec2;

constexpr std::int64_t kArmedStaleFactor = 10;  // factor on `stale_time` while armed: the first reading may take longer

// [s] Longest time without a cycle that is on time. After a longer gap (for example, because the process was stopped),
// lever and hand may be anywhere, so the previous force must not resume by itself. The stick's driver waits equally
// long for a command.
constexpr double kMaxLateTime = 0.1;  // [s]

// [cycles] Upper limit of all counters. It prevents overflow when a replayed trace contains a huge number of cycles.
constexpr std::int64_t kUnlimitedCycles = 1'000'000'000'000;

std::int64_t saturating_add(std::int64_t cycles, std::int64_t more) noexcept {
  return std::min(cycles + std::min(more, kUnlimitedCycles), kUnlimitedCycles);
}

}  // namespace

const char* to_string(GuardState state) noexcept {
  static constexpr const char* kNames[] = {"idle", "armed", "ramping", "running", "damped", "released"};
  return kNames[static_cast<int>(state)];
}

const char* describe(GuardState state) noexcept {
  static constexpr const char* kTexts[] = {
      "forces off", "forces armed", "forces starting", "forces on", "forces off, damping only", "motors off"};
  return kTexts[static_cast<int>(state)];
}

const char* to_string(GuardFault fault) noexcept {
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
      late_limit_(spec.simulated ? kUnlimitedCycles : std::llround(kMaxLateTime / period)) {}

GuardOutput ForceGuard::guard(const GuardInput& in) noexcept {
  check_faults(in);
  const dvec2 travel = in.position - position_;
  position_ = in.position;
  const GuardOutput out = compute_output(in, travel);
  newest_ = (newest_ + 1) % applied_.size();
  applied_[newest_] = out.force;
  return out;
}

GuardOutput ForceGuard::compute_output(const GuardInput& in, dvec2 travel) noexcept {
  if (state_ == GuardState::idle || state_ == GuardState::released) {
    last_force_ = {0.0, 0.0};
    return {};
  }
  if (state_ == GuardState::damped) return {glm::clamp(damped_force(in), -max_force_, max_force_), false};
  // The sum with the device's springs is kept within the maximum, too. Otherwise the device would limit it on each joint,
  // which turns the force: round a closed path such a force does work, and a heavy hand keeps swinging.
  const dvec2 lowest = glm::clamp(-max_force_ - in.beside, -max_force_, dvec2(0.0));
  const dvec2 highest = glm::clamp(max_force_ - in.beside, dvec2(0.0), max_force_);
  const dvec2 wanted = glm::clamp(apply_passivity_control(in, travel), lowest, highest);
  const dvec2 slewed = glm::clamp(wanted, last_force_ - config_.slew, last_force_ + config_.slew);
  last_force_ = glm::clamp(apply_energy_bounding(slewed, travel), -max_force_, max_force_);
  const auto exceeds = [this](dvec2 force) { return glm::any(glm::greaterThan(glm::abs(force), max_force_)); };
  const bool saturated = exceeds(in.force) || exceeds(in.force + in.beside);
  const double ramp = advance_ramp();
  return {last_force_ * ramp, saturated, ramp};
}

// Checks for every fault before a force is output. If several faults occur, the most severe fault is reported.
void ForceGuard::check_faults(const GuardInput& in) noexcept {
  // In the first cycle after a fresh reading, the missed cycles do not count as stale, because the device's thread may
  // have been stopped too.
  const std::int64_t elapsed = stale_cycles_ > 0 ? saturating_add(1, in.skipped) : 1;
  stale_cycles_ = in.fresh ? 0 : saturating_add(stale_cycles_, elapsed);
  late_cycles_ = in.skipped > 0 ? saturating_add(late_cycles_, in.skipped) : 0;
  overruns_ = in.skipped > 0 ? overruns_ + 1 : 0;
  const bool is_outside = std::abs(in.position.x) > position_limit_.x || std::abs(in.position.y) > position_limit_.y;
  if (!is_finite(in.force) || !is_finite(in.position) || !is_finite(in.velocity)) {
    return enter_fault(GuardState::released, GuardFault::not_finite);
  }
  if (is_outside) return enter_fault(GuardState::released, GuardFault::limit_broken);
  if (late_cycles_ > late_limit_) return enter_fault(GuardState::released, GuardFault::overruns);
  const std::int64_t limit = state_ == GuardState::armed ? kArmedStaleFactor * stale_limit_ : stale_limit_;
  if (stale_cycles_ > limit) return enter_fault(GuardState::damped, GuardFault::stale_reading);
  if (overruns_ >= config_.overruns_in_row) return enter_fault(GuardState::damped, GuardFault::overruns);
}

// Changes the state only towards `released`, and never from idle.
void ForceGuard::enter_fault(GuardState state, GuardFault fault) noexcept {
  if (state_ == GuardState::idle || state <= state_) return;
  state_ = state;
  fault_ = fault;
  fade_from_ = last_force_ * ramp_;
  fade_ = 1.0;
  ramp_ = 0.0;
}

// The energy balance uses the command that acted during `travel`.
dvec2 ForceGuard::apply_passivity_control(const GuardInput& in, dvec2 travel) noexcept {
  if (energy_control_ != EnergyControl::passivity_controller) return in.force;
  const dvec2 acted = applied_[(newest_ + applied_.size() - delay_) % applied_.size()];
  dvec2 force = in.force;
  for (int i = 0; i < 2; ++i)
    force[i] = controller_[static_cast<std::size_t>(i)].control(force[i], acted[i], travel[i], in.in_contact);
  return force;
}

// The bound starts from the newest command, even if that command has not taken effect yet. It is applied after the slew
// limit, so that a force that must drop can drop at once.
dvec2 ForceGuard::apply_energy_bounding(dvec2 force, dvec2 travel) const noexcept {
  if (energy_control_ != EnergyControl::energy_bounding) return force;
  for (int i = 0; i < 2; ++i)
    force[i] = bounder_[static_cast<std::size_t>(i)].bound(force[i], applied_[newest_][i], travel[i]);
  return force;
}

// The last force fades out within `fade_time`; damping is added while readings are fresh.
dvec2 ForceGuard::damped_force(const GuardInput& in) noexcept {
  fade_ = std::max(0.0, fade_ - period_ / config_.fade_time);
  const dvec2 damping = in.fresh ? -config_.damped_damping * in.velocity : dvec2{0.0, 0.0};
  return fade_ * fade_from_ + damping;
}

double ForceGuard::advance_ramp() noexcept {
  if (state_ == GuardState::armed && stale_cycles_ == 0) state_ = GuardState::ramping;
  if (state_ != GuardState::ramping) return state_ == GuardState::armed ? 0.0 : ramp_;
  ramp_ = std::min(1.0, ramp_ + period_ / config_.ramp_time);
  if (ramp_ == 1.0) state_ = GuardState::running;
  return ramp_;
}

bool ForceGuard::arm() noexcept {
  if (state_ == GuardState::armed || state_ == GuardState::ramping || state_ == GuardState::running) return false;
  state_ = GuardState::armed;
  fault_ = GuardFault::none;
  last_force_ = {0.0, 0.0};
  ramp_ = 0.0;
  stale_cycles_ = 0;
  late_cycles_ = 0;
  overruns_ = 0;
  applied_.fill({0.0, 0.0});
  for (PassivityController& controller : controller_) controller.reset();
  return true;
}

void ForceGuard::reject_arming() noexcept {
  fault_ = GuardFault::stopped;
}

void ForceGuard::disarm() noexcept {
  state_ = GuardState::idle;
  last_force_ = {0.0, 0.0};
  ramp_ = 0.0;
}

void ForceGuard::damp() noexcept {
  enter_fault(GuardState::damped, GuardFault::chatter);
}

void ForceGuard::stop() noexcept {
  if (state_ != GuardState::idle) enter_fault(GuardState::released, GuardFault::stopped);
}

}  // namespace gearshift::haptics
