#include "haptics/contact/lever_observer.h"

#include <algorithm>
#include <cmath>

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

namespace gearshift::haptics {
namespace {

using glm::dmat3;
using glm::dvec3;

constexpr std::int64_t kMaxSkippedCycles = 10;  // [cycles] longest gap that is simulated in full
constexpr int kMaxBlindCycles = 10;             // [cycles] the observer restarts after this many without a sample
constexpr double kIntervalWeight = 0.05;        // [1] of a new interval in the mean
constexpr double kIntervalChange = 0.75;        // [cycles] smaller changes of the mean are lost readings

// Transition matrix of (position, velocity, hand force) over one period: the columns are the images of the unit states.
dmat3 transition(const AxisStepper& stepper) noexcept {
  const AxisState x = stepper.step({1.0, 0.0}, 0.0), v = stepper.step({0.0, 1.0}, 0.0), w = stepper.step({}, 1.0);
  return {dvec3{x.position, x.velocity, 0.0}, dvec3{v.position, v.velocity, 0.0}, dvec3{w.position, w.velocity, 1.0}};
}

// Ackermann's formula for the observer gain L. The observer corrects its prediction with the sample of the same
// instant, so the estimation error evolves by the matrix (I - L C) A. The gain L = (A - pole I)^3 [C A; C A^2; C
// A^3]^-1 (0, 0, 1) places all eigenvalues of this matrix at `pole`.
dvec3 correction_gain(const dmat3& a, double pole) noexcept {
  const dmat3 shifted = a - dmat3(pole);
  const dvec3 first{a[0][0], a[1][0], a[2][0]};  // C A with C = (1, 0, 0)
  const dvec3 second = first * a, third = second * a;
  const dmat3 observability = glm::transpose(dmat3{first, second, third});
  return shifted * (shifted * (shifted * (glm::inverse(observability) * dvec3{0.0, 0.0, 1.0})));
}

}  // namespace

ObserverGain observer_gain(const AxisModel& axis, double bandwidth, double interval) noexcept {
  const dvec3 gain = correction_gain(transition(AxisStepper(axis, interval)), std::exp(-bandwidth * interval));
  return {gain.x, gain.y, gain.z};
}

AxisEstimate AxisObserver::predict(const AxisEstimate& estimate, double force) const noexcept {
  const AxisState next = stepper_.step({estimate.position, estimate.velocity}, force + estimate.hand);
  return {next.position, next.velocity, estimate.hand};
}

AxisEstimate AxisObserver::correct(const AxisEstimate& predicted, const ObserverGain& gain, double position) noexcept {
  const double error = position - predicted.position;
  return {predicted.position + gain[0] * error, predicted.velocity + gain[1] * error, predicted.hand + gain[2] * error};
}

LeverObserver::Axis::Axis(const AxisModel& model, double period) noexcept : observer(model, period) {
  for (std::size_t i = 0; i < gain.size(); ++i) {
    const double interval = static_cast<double>(i + 1) * period;
    gain[i] = observer_gain(model, observer_bandwidth(interval), interval);
  }
}

LeverObserver::LeverObserver(const DeviceSpec& spec, double period) noexcept
    : axis_{Axis(spec.axis_x, period), Axis(spec.axis_y, period)},
      spec_delay_(static_cast<std::size_t>(spec.delay)),
      delay_(spec_delay_) {}

ObservedMotion LeverObserver::update(const LeverMotion& motion, glm::dvec2 commanded, std::int64_t skipped) noexcept {
  for (std::int64_t n = std::min(skipped, kMaxSkippedCycles); n >= 0; --n) advance_period(commanded);
  track_interval(motion.fresh, skipped);
  ObservedMotion out;
  for (int i = 0; i < 2; ++i) {
    Axis& axis = axis_[static_cast<std::size_t>(i)];
    const AxisEstimate begin = estimate_at_effect(axis, i, motion);
    out.position[i] = begin.position;
    out.end[i] = axis.observer.predict(begin, 0.0).position;
    out.compliance[i] = axis.observer.compliance();
  }
  blind_cycles_ = motion.fresh ? 0 : std::min(blind_cycles_ + 1, kMaxBlindCycles);
  started_ = motion.fresh || (started_ && blind_cycles_ < kMaxBlindCycles);
  return out;
}

// The device's delay includes the wait for its next sample. The observer predicts from sample to sample, so commands act
// earlier for it by this wait.
void LeverObserver::track_interval(bool is_fresh, std::int64_t skipped) noexcept {
  if (!is_fresh || !started_ || skipped > 0) return;
  const double interval = 1.0 + blind_cycles_;
  mean_interval_ = mean_interval_ == 0.0 ? interval : mean_interval_ + kIntervalWeight * (interval - mean_interval_);
  if (std::abs(mean_interval_ - static_cast<double>(interval_)) < kIntervalChange) return;
  interval_ = std::min(static_cast<std::size_t>(std::lround(mean_interval_)), kMaxInterval);
  delay_ = spec_delay_ - std::min(spec_delay_, interval_ - 1);
}

// Advances the estimate by one period, under the command that was in effect during this period.
void LeverObserver::advance_period(glm::dvec2 commanded) noexcept {
  newest_ = (newest_ + 1) % commands_.size();
  commands_[newest_] = commanded;
  if (!started_) return;
  for (int i = 0; i < 2; ++i) {
    Axis& axis = axis_[static_cast<std::size_t>(i)];
    axis.estimate = axis.observer.predict(axis.estimate, command_before(delay_, i));
  }
}

double LeverObserver::command_before(std::size_t age, int axis) const noexcept {
  return commands_[(newest_ + commands_.size() - age) % commands_.size()][axis];
}

// Corrects the estimate with the newest sample. Then predicts it to the moment when the next command takes effect,
// using the commands that are still in the delay line.
AxisEstimate LeverObserver::estimate_at_effect(Axis& axis, int index, const LeverMotion& motion) noexcept {
  const double sample = motion.position[index];
  if (!started_) axis.estimate = {sample, 0.0, 0.0};
  if (motion.fresh) axis.estimate = AxisObserver::correct(axis.estimate, axis.gain[interval_ - 1], sample);
  AxisEstimate ahead = axis.estimate;
  for (std::size_t age = delay_; age > 0; --age) ahead = axis.observer.predict(ahead, command_before(age - 1, index));
  return ahead;
}

}  // namespace gearshift::haptics
