#include "haptics/hardware/force_watch.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gearshift::haptics {
namespace {

constexpr double kMaxSmoothing =
    2.0 * std::numbers::pi * 25.0;         // [rad/s] above, the stick's uncertain lag turns the phase
constexpr double kMaxTurn = 0.5;           // [rad] of the smoothing per reading
constexpr double kSlow = 0.2;              // [1] of the smoothing; below, hands can follow
constexpr double kMaxInterval = 0.1;       // [s] longer gaps between readings are shortened
constexpr double kMemory = 0.5;            // [s]
constexpr double kMaxReach = 0.95;         // [1] of the way to a stop
constexpr double kMaxSlope = -0.05;        // [1]
constexpr double kMinShare = 0.45;         // [1] of the motion's power that the force explains: the squared correlation
constexpr double kMinReversedTime = 0.02;  // [s]
constexpr double kMinPower = 1.0;          // [N^2 s] before the correlation counts

}  // namespace

// Critically damped: y'' = w^2 (u - y) - 2 w y', by semi-implicit Euler steps.
void ForceWatch::Smooth::update(double input, double frequency, double seconds) noexcept {
  acceleration = frequency * frequency * (input - value) - 2.0 * frequency * rate;
  rate += seconds * acceleration;
  value += seconds * rate;
}

ForceWatch::ForceWatch(const DeviceSpec& spec, double lag, double interval) noexcept
    : smoothing_(std::min(kMaxSmoothing, kMaxTurn / interval)),
      delay_(
          static_cast<std::size_t>(std::clamp(std::round(lag / interval), 0.0, static_cast<double>(kMaxLoopDelay)))) {
  axis_[0].handle = spec.axis_x;
  axis_[1].handle = spec.axis_y;
  axis_[0].reach = spec.workspace.x;
  axis_[1].reach = spec.workspace.y;
}

void ForceWatch::reset() noexcept {
  has_started_ = false;
  for (Axis& axis : axis_) {
    Axis fresh;
    fresh.handle = axis.handle;
    fresh.reach = axis.reach;
    axis = fresh;
  }
}

void ForceWatch::update(glm::dvec2 position, glm::dvec2 force, double seconds) noexcept {
  seconds = std::clamp(seconds, 0.0, std::min(kMaxInterval, 2.0 * kMaxTurn / smoothing_));
  if (!has_started_) {
    for (int i = 0; i < 2; ++i) axis_[static_cast<std::size_t>(i)].position.value = position[i];
    has_started_ = true;
  }
  at_ = (at_ + 1) % axis_[0].delayed.size();
  for (int i = 0; i < 2; ++i) update(axis_[static_cast<std::size_t>(i)], position[i], force[i], seconds);
}

void ForceWatch::update(Axis& axis, double position, double force, double seconds) noexcept {
  axis.delayed[at_] = force;
  axis.position.update(position, smoothing_, seconds);
  axis.force.update(axis.delayed[(at_ + axis.delayed.size() - delay_) % axis.delayed.size()], smoothing_, seconds);
  const AxisModel& handle = axis.handle;
  const double motion = handle.mass * axis.position.acceleration + handle.damping * axis.position.rate +
                        handle.stiffness * axis.position.value;
  const double slow = kSlow * smoothing_ * seconds;
  axis.slow_motion += slow * (motion - axis.slow_motion);
  axis.slow_force += slow * (axis.force.value - axis.slow_force);
  const double fast_motion = motion - axis.slow_motion, fast_force = axis.force.value - axis.slow_force;
  if (std::abs(position) > kMaxReach * axis.reach) return;
  const double fading = std::exp(-seconds / kMemory);
  axis.force_power = fading * axis.force_power + seconds * fast_force * fast_force;
  axis.motion_power = fading * axis.motion_power + seconds * fast_motion * fast_motion;
  axis.product = fading * axis.product + seconds * fast_force * fast_motion;
  axis.reversed_time = looks_reversed(axis) ? axis.reversed_time + seconds : 0.0;
}

bool ForceWatch::looks_reversed(const Axis& axis) noexcept {
  if (axis.force_power < kMinPower) return false;
  const double slope = axis.product / axis.force_power;
  return slope < kMaxSlope && slope * axis.product > kMinShare * axis.motion_power;
}

bool ForceWatch::is_reversed() const noexcept {
  return std::max(axis_[0].reversed_time, axis_[1].reversed_time) > kMinReversedTime;
}

double ForceWatch::correlation(int axis) const noexcept {
  const Axis& watched = axis_[static_cast<std::size_t>(axis)];
  if (watched.force_power < kMinPower || watched.motion_power == 0.0) return 0.0;
  return watched.product / std::sqrt(watched.force_power * watched.motion_power);
}

double ForceWatch::slope(int axis) const noexcept {
  const Axis& watched = axis_[static_cast<std::size_t>(axis)];
  return watched.force_power < kMinPower ? 0.0 : watched.product / watched.force_power;
}

}  // namespace gearshift::haptics
