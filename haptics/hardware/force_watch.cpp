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
  constexpr bool is_elastic() const noexcept { return grip_stiffness > 0.0; }
};
// No hand; hands as in hand.h and around them; the skin of a heavy hand; hands that let go or push suddenly; heavy hands
// behind a springy grip, which strike a wall like none of the others. One is there twice for an even number (kRigid).
constexpr std::array<Hand, 20> kAnyHand{{{{0.0, 0.0, 0.0}, 1.0},
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
constexpr std::int64_t kMaxGap = 20'000'000;     // [ns] between readings; bounds the steps of one cycle
constexpr double kPositionNoise = 30e-6;         // [m]
constexpr double kTimeNoise = 300e-6;            // [s] of readings and outputs
constexpr double kSpeedNoise = 0.2;              // [m/s / sqrt(s)] forces that the handle's model lacks
constexpr double kFirstSpeed = 0.1;              // [m/s] standard deviations at the start
constexpr double kInitialForceDeviation = 10.0;  // [N]
constexpr double kInitialStretch = 0.004;        // [m] of a grip

constexpr double squared(double value) noexcept {
  return value * value;
}

// As std::clamp, which the compiler cannot compute for two values at once.
constexpr double limited(double value, double low, double high) noexcept {
  const double raised = value < low ? low : value;
  return high < raised ? high : raised;
}

// One property of all hands.
template <typename Property>
constexpr auto each(Property property) noexcept {
  std::array<double, kAnyHand.size()> all{};
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = property(kAnyHand[i]);
  return all;
}
constexpr auto kBodyMobility = each([](const Hand& hand) { return hand.is_elastic() ? 1.0 / hand.body.mass : 0.0; });
constexpr auto kBodyDamping = each([](const Hand& hand) { return hand.body.damping; });
constexpr auto kBodyStiffness = each([](const Hand& hand) { return hand.body.stiffness; });
constexpr auto kPull = each([](const Hand& hand) { return hand.grip_stiffness; });
constexpr auto kDrag = each([](const Hand& hand) { return hand.grip_damping; });
constexpr auto kUnrest = each([](const Hand& hand) { return squared(hand.unrest); });

constexpr std::size_t kPositionState = 0, kBodyState = 3;

}  // namespace

ForceWatch::ForceWatch(const DeviceSpec& spec, double lag) noexcept
    : count_variance_(std::max(squared(spec.position_step) / 12.0, squared(kPositionNoise))),
      lag_ns_(std::llround(1e9 * lag)) {
  static_assert(kAnyHand.size() == kHands && kAnyStick.size() == kExplanations);
  static_assert(!kAnyHand[kRigid - 1].is_elastic() && kAnyHand[kRigid].is_elastic());
  for (int i = 0; i < 2; ++i) {
    Axis& axis = axis_[static_cast<std::size_t>(i)];
    const AxisModel& handle = i == 0 ? spec.axis_x : spec.axis_y;
    axis.reach = spec.workspace[i];
    axis.max_force = spec.max_force[i];
    for (std::size_t hand = 0; hand < kHands; ++hand) {
      const AxisModel body = hand < kRigid ? kAnyHand[hand].body : AxisModel{0.0, 0.0, 0.0};
      axis.mobility[hand] = 1.0 / (handle.mass + body.mass);
      axis.damping[hand] = handle.damping + body.damping;
      axis.stiffness[hand] = handle.stiffness + body.stiffness;
    }
  }
}

void ForceWatch::reset() noexcept {
  has_reading_ = drives_ = false;
  driving_ns_ = 0;
  outputs_.fill({});
  for (Axis& axis : axis_) {
    axis.estimate.fill({});
    axis.likelihood.fill(0.0);
  }
}

void ForceWatch::pause() noexcept {
  if (!has_reading_) return;
  if (drives_ || evidence(0, ForceFault::silent) + evidence(1, ForceFault::silent) <= 0.0) return reset();
  has_reading_ = false;
  outputs_.fill({});
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
  for (Estimate& estimate : axis.estimate) {
    for (Values& values : estimate.state) values.fill(0.0);
    estimate.state[kPositionState].fill(position);
    estimate.state[kBodyState].fill(position);
  }
  constexpr std::array<double, kStates> kDeviations{kPositionNoise, kFirstSpeed, kInitialForceDeviation,
                                                    kInitialStretch, kFirstSpeed};
  for (std::size_t i = 0; i < kStates; ++i) {
    for (Values& values : axis.covariance[i]) values.fill(0.0);
    axis.covariance[i][i].fill(squared(kDeviations[i]));
  }
}

// Per step: x += v dt, v += (u - b v - k x + h) dt / m, with the mass, damping and stiffness of handle and hand. An
// elastic hand moves by itself, X += V dt, V += (h - B V - K X - g) dt / M, and pulls the handle with its grip's force g =
// b_g (V - v) + k_g (X - x) instead of h.
void ForceWatch::predict(Axis& axis, const AxisForces& forces, double seconds) noexcept {
  const double s = seconds;
  auto& [px, pv, ph, pb, pw] = axis.covariance;  // rows
  for (std::size_t i = 0; i < kRigid; ++i) {
    const double step = s * axis.mobility[i], hold = -axis.stiffness[i] * step, keep = 1.0 - axis.damping[i] * step;
    const double xv = px[1][i] + s * pv[1][i], xh = px[2][i] + s * pv[2][i],
                 vx = hold * px[0][i] + keep * px[1][i] + step * px[2][i],
                 vv = hold * px[1][i] + keep * pv[1][i] + step * pv[2][i],
                 vh = hold * px[2][i] + keep * pv[2][i] + step * ph[2][i];
    px[0][i] += s * (px[1][i] + xv);
    px[1][i] = vx + s * vv;
    px[2][i] = xh;
    pv[1][i] = hold * vx + keep * vv + step * vh + s * squared(kSpeedNoise);
    pv[2][i] = vh;
    ph[2][i] += s * kUnrest[i];
  }
  for (std::size_t i = kRigid; i < kHands; ++i) {
    const double step = s * axis.mobility[i], body_step = s * kBodyMobility[i];
    const double pull = step * kPull[i], drag = step * kDrag[i], hold = -axis.stiffness[i] * step - pull,
                 keep = 1.0 - axis.damping[i] * step - drag;
    const double body_pull = body_step * kPull[i], body_drag = body_step * kDrag[i],
                 body_hold = -kBodyStiffness[i] * body_step - body_pull,
                 body_keep = 1.0 - kBodyDamping[i] * body_step - body_drag;
    // The transition of a column, then of a row.
    const auto speed = [=](double x, double v, double b, double w) {
      return hold * x + keep * v + pull * b + drag * w;
    };
    const auto body_speed = [=](double x, double v, double h, double b, double w) {
      return body_pull * x + body_drag * v + body_step * h + body_hold * b + body_keep * w;
    };
    const double xx = px[0][i], xv = px[1][i], xh = px[2][i], xb = px[3][i], xw = px[4][i], vv = pv[1][i],
                 vh = pv[2][i], vb = pv[3][i], vw = pv[4][i], hh = ph[2][i], hb = ph[3][i], hw = ph[4][i],
                 bb = pb[3][i], bw = pb[4][i], ww = pw[4][i];
    const double Xx = xx + s * xv, Xv = xv + s * vv, Xh = xh + s * vh, Xb = xb + s * vb, Xw = xw + s * vw;
    const double Vx = speed(xx, xv, xb, xw), Vv = speed(xv, vv, vb, vw), Vh = speed(xh, vh, hb, hw),
                 Vb = speed(xb, vb, bb, bw), Vw = speed(xw, vw, bw, ww);
    const double Bx = xb + s * xw, Bv = vb + s * vw, Bh = hb + s * hw, Bb = bb + s * bw, Bw = bw + s * ww;
    const double Wx = body_speed(xx, xv, xh, xb, xw), Wv = body_speed(xv, vv, vh, vb, vw),
                 Wh = body_speed(xh, vh, hh, hb, hw), Wb = body_speed(xb, vb, hb, bb, bw),
                 Ww = body_speed(xw, vw, hw, bw, ww);
    px[0][i] = Xx + s * Xv;
    px[1][i] = Vx + s * Vv;
    px[2][i] = Xh;
    px[3][i] = Xb + s * Xw;
    px[4][i] = Wx + s * Wv;
    pv[1][i] = speed(Vx, Vv, Vb, Vw) + s * squared(kSpeedNoise);
    pv[2][i] = Vh;
    pv[3][i] = Vb + s * Vw;
    pv[4][i] = body_speed(Vx, Vv, Vh, Vb, Vw);
    ph[2][i] = hh + s * kUnrest[i];
    ph[3][i] = Bh;
    ph[4][i] = Wh;
    pb[3][i] = Bb + s * Bw;
    pb[4][i] = body_speed(Bx, Bv, Bh, Bb, Bw);
    pw[4][i] = body_speed(Wx, Wv, Wh, Wb, Ww);
  }
  const double low = forces.low, high = forces.high, full = axis.max_force;
  for (std::size_t stick = 0; stick < kExplanations; ++stick) {
    auto& state = axis.estimate[stick].state;  // no structured binding, because the lambda captures two of them
    Values &position = state[0], &speed = state[1], &body = state[3], &body_speed = state[4];
    const Values& hand = state[2];
    const double constant = kAnyStick[stick].constants * forces.constant;
    const double stiffness = kAnyStick[stick].conditions * forces.stiffness;
    const double damping = kAnyStick[stick].conditions * forces.damping;
    const auto acceleration = [&](std::size_t i, double grip) {
      const double depth = position[i] - limited(position[i], low, high);
      const double force = limited(constant - stiffness * depth - damping * speed[i], -full, full);
      return axis.mobility[i] * (force - axis.damping[i] * speed[i] - axis.stiffness[i] * position[i] + grip);
    };
    for (std::size_t i = 0; i < kRigid; ++i) {
      const double a = acceleration(i, hand[i]);
      position[i] += s * (speed[i] + 0.5 * s * a);
      speed[i] += s * a;
    }
    for (std::size_t i = kRigid; i < kHands; ++i) {
      const double grip = kPull[i] * (body[i] - position[i]) + kDrag[i] * (body_speed[i] - speed[i]);
      const double a = acceleration(i, grip);
      const double other =
          kBodyMobility[i] * (hand[i] - grip - kBodyDamping[i] * body_speed[i] - kBodyStiffness[i] * body[i]);
      body[i] += s * (body_speed[i] + 0.5 * s * other);
      body_speed[i] += s * other;
      position[i] += s * (speed[i] + 0.5 * s * a);
      speed[i] += s * a;
    }
  }
}

// A reading counts as far as a right and a silent stick would move differently. Otherwise, a lever at rest would tell
// hands apart, and with them the sticks.
void ForceWatch::correct(Axis& axis, double position, double speed, double seconds) const noexcept {
  const double noise = count_variance_ + squared(kTimeNoise * speed);
  const auto typical = [&](std::size_t stick) { return axis.estimate[stick].state[kPositionState][kTypicalHand]; };
  const double information =
      squared(typical(kRight) - typical(kSilent)) / (axis.covariance[0][0][kTypicalHand] + noise);
  const double weight = std::min(1.0, information / (kTelling * seconds));
  const double fading = std::exp(-weight * seconds / kMemory);
  const std::array<Values, kStates> first = axis.covariance[0];
  std::array<Values, kStates> gain;
  Values precision, log_variance;
  for (std::size_t i = 0; i < kHands; ++i) precision[i] = 1.0 / (first[0][i] + noise);
  for (std::size_t i = 0; i < kHands; ++i) log_variance[i] = -std::log(precision[i]);
  for (std::size_t row = 0; row < kStates; ++row) {
    for (std::size_t i = 0; i < kHands; ++i) gain[row][i] = first[row][i] * precision[i];
  }
  for (std::size_t row = 0; row < kStates; ++row) {
    for (std::size_t column = row; column < kStates; ++column) {
      for (std::size_t i = column < kRigidStates ? 0 : kRigid; i < kHands; ++i)
        axis.covariance[row][column][i] -= gain[row][i] * first[column][i];
    }
  }
  for (std::size_t stick = 0; stick < kExplanations; ++stick) {
    Estimate& estimate = axis.estimate[stick];
    Values error;
    for (std::size_t i = 0; i < kHands; ++i) error[i] = position - estimate.state[kPositionState][i];
    for (std::size_t row = 0; row < kStates; ++row) {
      for (std::size_t i = row < kRigidStates ? 0 : kRigid; i < kHands; ++i)
        estimate.state[row][i] += gain[row][i] * error[i];
    }
    for (std::size_t i = 0; i < kHands; ++i) {
      const double surprise = std::min(squared(error[i]) * precision[i], kMaxSurprise) + log_variance[i];
      estimate.likelihood[i] = fading * estimate.likelihood[i] - 0.5 * weight * surprise;
    }
    axis.likelihood[stick] = *std::max_element(estimate.likelihood.begin(), estimate.likelihood.end());
  }
}

bool ForceWatch::may_be_silent() const noexcept {
  const bool drove = drives_ && time_ns_ - driving_ns_ < kSilentTime;
  return !drove &&
         evidence(0, ForceFault::silent) + evidence(1, ForceFault::silent) > (drives_ ? kMaybeSilent : kNeverDrove);
}

double ForceWatch::evidence(int axis, ForceFault fault) const noexcept {
  const auto& likelihood = axis_[static_cast<std::size_t>(axis)].likelihood;
  double best = -std::numeric_limits<double>::infinity();
  for (std::size_t stick = 0; stick < kExplanations; ++stick) {
    if (kAnyStick[stick].fault == fault) best = std::max(best, likelihood[stick]);
  }
  return best - likelihood[kRight];
}

ForceFault ForceWatch::fault(bool is_doubtful) const noexcept {
  double all_silent = 0.0;
  for (const Axis& axis : axis_) {
    const double right = axis.likelihood[kRight], silent = axis.likelihood[kSilent] - right;
    for (std::size_t stick = 0; stick < kExplanations; ++stick) {
      const Explanation& explanation = kAnyStick[stick];
      if (explanation.fault != ForceFault::reversed) continue;
      if (axis.likelihood[stick] - right > std::max(explanation.min_evidence, silent)) return ForceFault::reversed;
    }
    // Both motors have the same power supply, so an axis that drives outweighs one that only seems to be silent.
    all_silent += silent;
  }
  const double min_silent = is_doubtful && !drives_ ? kMinDoubtful : kAnyStick[kSilent].min_evidence;
  return all_silent > min_silent ? ForceFault::silent : ForceFault::none;
}

}  // namespace gearshift::haptics
