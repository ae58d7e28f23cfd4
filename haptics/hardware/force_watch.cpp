#include "haptics/hardware/force_watch.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gearshift::haptics {
namespace {

struct Hand {
  AxisModel body;
  double unrest;                // [N / sqrt(s)] how fast its force wanders
  double grip_damping = 0.0;    // [N s/m] of an elastic hand, whose body is a second mass (see hand.h)
  double grip_stiffness = 0.0;  // [N/m] 0: the body moves with the lever
  bool is_elastic() const noexcept { return grip_stiffness > 0.0; }
};
// No hand; hands as in hand.h and around them; the skin of a heavy hand; hands that let go or push suddenly; heavy hands
// behind a springy grip, which strike a wall like none of the others.
constexpr std::array<Hand, 19> kAnyHand{{{{0.0, 0.0, 0.0}, 1.0},
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
                                         {{0.0, 4.0, 4000.0}, 80.0},
                                         {{0.3, 10.0, 200.0}, 40.0, 8.0, 2500.0},
                                         {{0.3, 10.0, 200.0}, 40.0, 10.0, 6000.0},
                                         {{1.0, 15.0, 200.0}, 40.0, 8.0, 2500.0},
                                         {{1.0, 15.0, 200.0}, 40.0, 10.0, 6000.0},
                                         {{2.5, 25.0, 300.0}, 60.0, 8.0, 2500.0},
                                         {{2.5, 25.0, 300.0}, 60.0, 10.0, 6000.0}}};
constexpr std::size_t kTypicalHand = 4;

struct Explanation {
  ForceFault fault;
  double constants, conditions;  // [1] actual over believed force
  double min_evidence;           // [nat] Large, because a hand may be none of those above.
};
// Springs whose sign alone is wrong need more evidence: in some hands that are none of those above, they explain an arm
// that strikes a wall by up to 39 nat better than a right stick. A silent stick is harmless, so it may be found later.
constexpr std::array<Explanation, 4> kAnyStick{{{ForceFault::none, 1.0, 1.0, 0.0},
                                                {ForceFault::reversed, -1.0, -1.0, 24.0},
                                                {ForceFault::silent, 0.0, 0.0, 90.0},
                                                {ForceFault::reversed, 1.0, -1.0, 60.0}}};
constexpr std::size_t kRight = 0, kSilent = 2;

constexpr double kMinDoubtful = 6.0,
                 kMinDriving = 10.0;  // [nat] for a fault that the stick reports; that forces are seen
constexpr double kMaybeSilent = 6.0,
                 kNeverDrove = 3.5;                  // [nat] that no motor acts; the same before forces were ever seen
constexpr std::int64_t kSilentTime = 4'000'000'000;  // [ns] since the forces were seen
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
constexpr double kInitialStretch = 0.004;        // [m] of a grip

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
  driving_ns_ = 0;
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
  for (int axis = 0; axis < 2; ++axis) {
    if (evidence(axis, ForceFault::silent) >= -kMinDriving) continue;
    drives_ = true;
    driving_ns_ = time_ns;
  }
  has_reading_ = true;
  position_ = position;
  time_ns_ = time_ns;
}

void ForceWatch::place(Axis& axis, double position) noexcept {
  for (auto& estimates : axis.estimate) {
    for (Estimate& estimate : estimates) estimate = {position, 0.0, 0.0, position, 0.0, estimate.likelihood};
  }
  const std::array<double, kStates> deviations{kPositionNoise, kFirstSpeed, kInitialForceDeviation, kInitialStretch,
                                               kFirstSpeed};
  for (Covariance& covariance : axis.covariance) {
    covariance = {};
    for (std::size_t i = 0; i < kStates; ++i) covariance[i][i] = squared(deviations[i]);
  }
}

// Per step: x += v dt, v += (u - b v - k x + h) dt / m, with the mass, damping and stiffness of handle and hand. An
// elastic hand moves by itself, X += V dt, V += (h - B V - K X - g) dt / M, and pulls the handle with its grip's force g =
// b_g (V - v) + k_g (X - x) instead of h.
void ForceWatch::predict(Axis& axis, const AxisForces& forces, double seconds) noexcept {
  for (std::size_t number = 0; number < kHands; ++number) {
    const Hand& hand = kAnyHand[number];
    const bool is_elastic = hand.is_elastic();
    const AxisModel& body = hand.body;
    const AxisModel lever{axis.handle.mass + (is_elastic ? 0.0 : body.mass),
                          axis.handle.damping + (is_elastic ? 0.0 : body.damping),
                          axis.handle.stiffness + (is_elastic ? 0.0 : body.stiffness)};
    const double s = seconds, lever_step = s / lever.mass, body_step = is_elastic ? s / body.mass : 0.0;
    const double pull = hand.grip_stiffness, drag = hand.grip_damping;
    const std::array<double, kStates> speed{-(lever.stiffness + pull) * lever_step,
                                            1.0 - (lever.damping + drag) * lever_step, is_elastic ? 0.0 : lever_step,
                                            pull * lever_step, drag * lever_step};
    const std::array<double, kStates> body_speed{pull * body_step, drag * body_step, body_step,
                                                 -(body.stiffness + pull) * body_step,
                                                 1.0 - (body.damping + drag) * body_step};
    const std::size_t states = is_elastic ? kStates : kRigidStates;
    // The transition of one state: each column of the covariance, then each row.
    const auto moved = [&](const std::array<double, kStates>& old) {
      std::array<double, kStates> next{old[0] + s * old[1], 0.0, old[2], old[3] + s * old[4], 0.0};
      for (std::size_t i = 0; i < states; ++i) next[1] += speed[i] * old[i];
      if (is_elastic)
        for (std::size_t i = 0; i < states; ++i) next[4] += body_speed[i] * old[i];
      return next;
    };
    Covariance& covariance = axis.covariance[number];
    Covariance half{};
    for (std::size_t i = 0; i < states; ++i) half[i] = moved(covariance[i]);
    for (std::size_t j = 0; j < states; ++j) {
      std::array<double, kStates> column{};
      for (std::size_t i = 0; i < states; ++i) column[i] = half[i][j];
      covariance[j] = moved(column);
    }
    covariance[1][1] += s * squared(kSpeedNoise);
    covariance[2][2] += s * squared(hand.unrest);
    for (std::size_t stick = 0; stick < kExplanations; ++stick) {
      Estimate& now = axis.estimate[stick][number];
      const double depth = now.position - std::clamp(now.position, forces.low, forces.high);
      const double condition = -forces.stiffness * depth - forces.damping * now.speed;
      const Explanation& explanation = kAnyStick[stick];
      const double force = std::clamp(explanation.constants * forces.constant + explanation.conditions * condition,
                                      -axis.max_force, axis.max_force);
      const double grip =
          is_elastic ? pull * (now.body - now.position) + drag * (now.body_speed - now.speed) : now.hand;
      const double acceleration =
          (force - lever.damping * now.speed - lever.stiffness * now.position + grip) / lever.mass;
      if (is_elastic) {
        const double other = (now.hand - grip - body.damping * now.body_speed - body.stiffness * now.body) / body.mass;
        now.body += s * (now.body_speed + 0.5 * s * other);
        now.body_speed += s * other;
      }
      now.position += s * (now.speed + 0.5 * s * acceleration);
      now.speed += s * acceleration;
    }
  }
}

// A reading counts as far as a right and a silent stick would move differently. Otherwise, a lever at rest would tell
// hands apart, and with them the sticks.
void ForceWatch::correct(Axis& axis, double position, double speed, double seconds) const noexcept {
  const double noise = count_variance_ + squared(kTimeNoise * speed);
  const double difference =
      axis.estimate[kRight][kTypicalHand].position - axis.estimate[kSilent][kTypicalHand].position;
  const double information = squared(difference) / (axis.covariance[kTypicalHand][0][0] + noise);
  const double weight = std::min(1.0, information / (kTelling * seconds));
  const double fading = std::exp(-weight * seconds / kMemory);
  for (std::size_t hand = 0; hand < kHands; ++hand) {
    const std::size_t states = kAnyHand[hand].is_elastic() ? kStates : kRigidStates;
    Covariance& covariance = axis.covariance[hand];
    const double variance = covariance[0][0] + noise, log_variance = std::log(variance);
    std::array<double, kStates> gain{};
    for (std::size_t i = 0; i < states; ++i) gain[i] = covariance[0][i] / variance;
    for (auto& estimates : axis.estimate) {
      Estimate& now = estimates[hand];
      const double error = position - now.position;
      const double surprise = std::min(squared(error) / variance, kMaxSurprise) + log_variance;
      now = {now.position + gain[0] * error,   now.speed + gain[1] * error,
             now.hand + gain[2] * error,       now.body + gain[3] * error,
             now.body_speed + gain[4] * error, fading * now.likelihood - 0.5 * weight * surprise};
    }
    const std::array<double, kStates> first = covariance[0];
    for (std::size_t i = 0; i < states; ++i) {
      for (std::size_t j = 0; j < states; ++j) covariance[i][j] -= gain[i] * first[j];
    }
  }
}

double ForceWatch::likelihood(int axis, std::size_t stick) const noexcept {
  double best = -std::numeric_limits<double>::infinity();
  for (const Estimate& estimate : axis_[static_cast<std::size_t>(axis)].estimate[stick])
    best = std::max(best, estimate.likelihood);
  return best;
}

bool ForceWatch::may_be_silent() const noexcept {
  const bool drove = drives_ && time_ns_ - driving_ns_ < kSilentTime;
  return !drove &&
         evidence(0, ForceFault::silent) + evidence(1, ForceFault::silent) > (drives_ ? kMaybeSilent : kNeverDrove);
}

double ForceWatch::evidence(int axis, ForceFault fault) const noexcept {
  double best = -std::numeric_limits<double>::infinity();
  for (std::size_t stick = 0; stick < kExplanations; ++stick) {
    if (kAnyStick[stick].fault == fault) best = std::max(best, likelihood(axis, stick));
  }
  return best - likelihood(axis, kRight);
}

ForceFault ForceWatch::fault(bool is_doubtful) const noexcept {
  double all_silent = 0.0;
  for (int axis = 0; axis < 2; ++axis) {
    const double right = likelihood(axis, kRight), silent = likelihood(axis, kSilent) - right;
    for (std::size_t stick = 0; stick < kExplanations; ++stick) {
      const Explanation& explanation = kAnyStick[stick];
      if (explanation.fault != ForceFault::reversed) continue;
      if (likelihood(axis, stick) - right > std::max(explanation.min_evidence, silent)) return ForceFault::reversed;
    }
    // Both motors have the same power supply, so an axis that drives outweighs one that only seems to be silent.
    all_silent += silent;
  }
  const double min_silent = is_doubtful && !drives_ ? kMinDoubtful : kAnyStick[kSilent].min_evidence;
  return all_silent > min_silent ? ForceFault::silent : ForceFault::none;
}

}  // namespace gearshift::haptics
