#include "haptics/hardware/force_watch.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gearshift::haptics {
namespace {

struct Hand {
  AxisModel body;
  double unrest;  // [N / sqrt(s)] how fast its force wanders
};
// No hand; hands as in hand.h and around them; the skin of a heavy hand; hands that let go or push suddenly.
constexpr std::array<Hand, 13> kAnyHand{{{{0.0, 0.0, 0.0}, 1.0},
                                         {{0.02, 2.0, 100.0}, 8.0},
                                         {{0.1, 5.0, 200.0}, 12.0},
                                         {{0.15, 10.0, 500.0}, 16.0},
                                         {{0.8, 5.5, 568.0}, 20.0},
                                         {{2.5, 20.0, 1500.0}, 32.0},
                                         {{0.0, 4.0, 4000.0}, 20.0},
                                         {{0.05, 10.0, 2000.0}, 20.0},
                                         {{0.0, 0.0, 0.0}, 50.0},
                                         {{0.15, 10.0, 500.0}, 50.0},
                                         {{5.0, 40.0, 3000.0}, 60.0},
                                         {{2.5, 20.0, 1500.0}, 100.0},
                                         {{0.0, 4.0, 4000.0}, 80.0}}};
constexpr std::size_t kTypicalHand = 4;

struct Explanation {
  ForceFault fault;
  double constants, conditions;  // [1] actual over believed force
};
constexpr std::array<Explanation, 4> kAnyStick{{{ForceFault::none, 1.0, 1.0},
                                                {ForceFault::reversed, -1.0, -1.0},
                                                {ForceFault::silent, 0.0, 0.0},
                                                {ForceFault::reversed, 1.0, -1.0}}};
constexpr std::size_t kRight = 0, kSilent = 2;

// [nat] Large, because a heavy hand behind a springy grip is none of the hands above. A silent stick is harmless, so it may
// be found later.
constexpr double kMinReversed = 24.0, kMinSilent = 90.0, kMinDoubtful = 6.0, kMinDriving = 10.0;
constexpr double kMemory = 1.5;                  // [s] of telling motion; readings that tell nothing are not counted
constexpr double kTelling = 400.0;               // [1/s] squared difference between right and silent, over the variance
constexpr double kMaxSurprise = 25.0;            // [1] squared error over its variance: a single reading proves little
constexpr double kMaxReach = 0.95;               // [1] of the way to a stop
constexpr double kMaxStep = 0.001;               // [s]
constexpr std::int64_t kMaxGap = 100'000'000;    // [ns] between readings
constexpr double kPositionNoise = 30e-6;         // [m]
constexpr double kTimeNoise = 300e-6;            // [s] of readings and outputs
constexpr double kSpeedNoise = 0.2;              // [m/s / sqrt(s)] forces that the handle's model lacks
constexpr double kFirstSpeed = 0.1;              // [m/s] standard deviations at the start
constexpr double kInitialForceDeviation = 10.0;  // [N]

constexpr double squared(double value) noexcept {
  return value * value;
}

}  // namespace

ForceWatch::ForceWatch(const DeviceSpec& spec, double lag) noexcept
    : count_variance_(std::max(squared(spec.position_step) / 12.0, squared(kPositionNoise))),
      lag_ns_(std::llround(1e9 * lag)) {
  static_assert(kAnyHand.size() == kHands && kAnyStick.size() == kExplanations);
  for (int i = 0; i < 2; ++i) {
    Axis& axis = axis_[static_cast<std::size_t>(i)];
    axis.handle = i == 0 ? spec.axis_x : spec.axis_y;
    axis.reach = spec.workspace[i];
    axis.max_force = spec.max_force[i];
  }
}

void ForceWatch::reset() noexcept {
  has_reading_ = drives_ = false;
  outputs_.fill({});
  for (Axis& axis : axis_) {
    for (auto& estimates : axis.estimate) estimates.fill({});
  }
}

void ForceWatch::on_output(const StickForces& forces, std::int64_t time_ns) noexcept {
  if (forces == outputs_[newest_].forces) return;
  newest_ = (newest_ + 1) % outputs_.size();
  outputs_[newest_] = {forces, time_ns};
}

const ForceWatch::Output& ForceWatch::output_at(std::int64_t time_ns) const noexcept {
  std::size_t at = newest_;
  for (std::size_t i = 1; i < outputs_.size() && outputs_[at].time_ns > time_ns; ++i)
    at = (at + outputs_.size() - 1) % outputs_.size();
  return outputs_[at];
}

void ForceWatch::on_reading(glm::dvec2 position, std::int64_t time_ns) noexcept {
  const std::int64_t passed_ns = time_ns - time_ns_;
  if (has_reading_ && passed_ns <= 0) return;
  const bool continues = has_reading_ && passed_ns <= kMaxGap;
  const double seconds = 1e-9 * static_cast<double>(passed_ns);
  const int steps = continues ? static_cast<int>(std::ceil(seconds / kMaxStep - 1e-3)) : 0;
  for (int step = 0; step < steps; ++step) {
    const StickForces& forces = output_at(time_ns_ + passed_ns * step / steps - lag_ns_).forces;
    for (std::size_t i = 0; i < 2; ++i) predict(axis_[i], forces[i], seconds / steps);
  }
  for (int i = 0; i < 2; ++i) {
    Axis& axis = axis_[static_cast<std::size_t>(i)];
    // At a stop, an unknown force acts.
    const bool is_free = std::abs(position[i]) <= kMaxReach * axis.reach;
    if (continues && is_free) {
      correct(axis, position[i], (position[i] - position_[i]) / seconds, seconds);
    } else {
      place(axis, position[i]);
    }
  }
  for (int axis = 0; axis < 2; ++axis) drives_ = drives_ || evidence(axis, ForceFault::silent) < -kMinDriving;
  has_reading_ = true;
  position_ = position;
  time_ns_ = time_ns;
}

void ForceWatch::place(Axis& axis, double position) noexcept {
  for (auto& estimates : axis.estimate) {
    for (Estimate& estimate : estimates) estimate = {position, 0.0, 0.0, estimate.likelihood};
  }
  axis.covariance.fill({squared(kPositionNoise), 0.0, 0.0, squared(kFirstSpeed), 0.0, squared(kInitialForceDeviation)});
}

// Per step: x += v dt, v += (u - b v - k x + h) dt / m, with the mass, damping and stiffness of handle and hand.
void ForceWatch::predict(Axis& axis, const AxisForces& forces, double seconds) noexcept {
  for (std::size_t hand = 0; hand < kHands; ++hand) {
    const AxisModel& body = kAnyHand[hand].body;
    const double mass = axis.handle.mass + body.mass, damping = axis.handle.damping + body.damping,
                 stiffness = axis.handle.stiffness + body.stiffness;
    const double vx = -stiffness / mass * seconds, vv = 1.0 - damping / mass * seconds, vh = seconds / mass;
    const Covariance old = axis.covariance[hand];
    const double xx = old.xx + seconds * old.xv, xv = old.xv + seconds * old.vv, xh = old.xh + seconds * old.vh;
    const double wx = vx * old.xx + vv * old.xv + vh * old.xh, wv = vx * old.xv + vv * old.vv + vh * old.vh,
                 wh = vx * old.xh + vv * old.vh + vh * old.hh;
    axis.covariance[hand] = {xx + seconds * xv,
                             vx * xx + vv * xv + vh * xh,
                             xh,
                             vx * wx + vv * wv + vh * wh + seconds * squared(kSpeedNoise),
                             wh,
                             old.hh + seconds * squared(kAnyHand[hand].unrest)};
    for (std::size_t stick = 0; stick < kExplanations; ++stick) {
      Estimate& now = axis.estimate[stick][hand];
      const double depth = now.position - std::clamp(now.position, forces.low, forces.high);
      const double condition = -forces.stiffness * depth - forces.damping * now.speed;
      const Explanation& explanation = kAnyStick[stick];
      const double force = std::clamp(explanation.constants * forces.constant + explanation.conditions * condition,
                                      -axis.max_force, axis.max_force);
      const double acceleration = (force - damping * now.speed - stiffness * now.position + now.hand) / mass;
      now.position += seconds * (now.speed + 0.5 * seconds * acceleration);
      now.speed += seconds * acceleration;
    }
  }
}

// A reading counts as far as a right and a silent stick would move differently. Otherwise, a lever at rest would tell
// hands apart, and with them the sticks.
void ForceWatch::correct(Axis& axis, double position, double speed, double seconds) const noexcept {
  const double noise = count_variance_ + squared(kTimeNoise * speed);
  const double difference =
      axis.estimate[kRight][kTypicalHand].position - axis.estimate[kSilent][kTypicalHand].position;
  const double information = squared(difference) / (axis.covariance[kTypicalHand].xx + noise);
  const double weight = std::min(1.0, information / (kTelling * seconds));
  const double fading = std::exp(-weight * seconds / kMemory);
  for (std::size_t hand = 0; hand < kHands; ++hand) {
    Covariance& c = axis.covariance[hand];
    const double variance = c.xx + noise, gain_x = c.xx / variance, gain_v = c.xv / variance, gain_h = c.xh / variance;
    const double log_variance = std::log(variance);
    for (auto& estimates : axis.estimate) {
      Estimate& now = estimates[hand];
      const double error = position - now.position;
      const double surprise = std::min(squared(error) / variance, kMaxSurprise) + log_variance;
      now = {now.position + gain_x * error, now.speed + gain_v * error, now.hand + gain_h * error,
             fading * now.likelihood - 0.5 * weight * surprise};
    }
    c = {c.xx - gain_x * c.xx, c.xv - gain_x * c.xv, c.xh - gain_x * c.xh,
         c.vv - gain_v * c.xv, c.vh - gain_v * c.xh, c.hh - gain_h * c.xh};
  }
}

double ForceWatch::evidence(int axis, ForceFault fault) const noexcept {
  double best = -std::numeric_limits<double>::infinity(), right = best;
  for (std::size_t stick = 0; stick < kExplanations; ++stick) {
    for (const Estimate& estimate : axis_[static_cast<std::size_t>(axis)].estimate[stick]) {
      if (kAnyStick[stick].fault == fault) best = std::max(best, estimate.likelihood);
      if (stick == kRight) right = std::max(right, estimate.likelihood);
    }
  }
  return best - right;
}

ForceFault ForceWatch::fault(bool is_doubtful) const noexcept {
  double silent = 0.0;
  for (int axis = 0; axis < 2; ++axis) {
    const double reversed = evidence(axis, ForceFault::reversed);
    if (reversed > std::max(kMinReversed, evidence(axis, ForceFault::silent))) return ForceFault::reversed;
    // Both motors have the same power supply, so an axis that drives outweighs one that only seems to be silent.
    silent += evidence(axis, ForceFault::silent);
  }
  return silent > (is_doubtful && !drives_ ? kMinDoubtful : kMinSilent) ? ForceFault::silent : ForceFault::none;
}

}  // namespace gearshift::haptics
