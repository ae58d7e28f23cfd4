#include "haptics/contact/reversal_limiter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gearshift::haptics {
namespace {

constexpr double kReversalCounts = 4.0;     // [counts] motion back that counts as a reversal; exceeds rounding
constexpr double kMinCount = 20e-6;         // [m] smallest encoder count assumed
constexpr double kReversalWindow = 0.35;    // [s] eight reversals within this time are chatter (10 Hz or faster)
constexpr double kTremorWidth = 0.8e-3;     // [m] widest swing of a hand's tremor, from reversal to reversal
constexpr double kTremorWindow = 0.28;      // [s] replaces kReversalWindow for narrow swings (12.5 Hz or faster)
constexpr double kNarrowTime = 0.25;        // [s] as long after a narrow swing
constexpr double kVibrationTimeout = 0.25;  // [s] longest time between two reversals of a vibration (2 Hz or faster)
constexpr double kContactWindow = 0.25;     // [s] chatter so long after the lever left a wall is not caused by the wall
constexpr double kDying = 0.5;              // [1] a swing that shrinks to this fraction dies away by itself
constexpr std::size_t kMaxStruckTurns = 24;   // reversals for which a hand may strike a dying swing again and again
constexpr double kCalmTime = 0.5;             // [s] after this time without chatter the lever counts as calm
constexpr double kSoftening = 0.75;           // [1] each detection of chatter multiplies the stiffness by this factor
constexpr double kFloorFactor = 0.3;          // [1] stiffness floor as a factor on m / tau^2 (see the header)
constexpr int kMaxBounces = 3;                // up to this many detections at the floor may be one decaying bounce
constexpr double kSofteningBelowFloor = 0.5;  // [1] factor on the stiffness per detection once a bounce is ruled out
constexpr double kMinFraction = 1.0 / 64.0;   // [1] fraction of the wanted stiffness at which softening has failed
constexpr double kMinVibration = 0.02;        // [N] weaker vibrations cannot move a lever by four counts
constexpr double kVibrationMargin = 1.25;     // [1] factor on `max_forced_swing_`: no real vibration is a pure sine
constexpr int kMaxPendingTurns = 2;           // vibration reversals by which the lever may lag, one per direction

}  // namespace

ReversalLimiter::ReversalLimiter(const DeviceSpec& spec, double period) noexcept
    : period_(period),
      reversal_step_(kReversalCounts * std::max(spec.position_step, kMinCount)),
      damping_(std::min(spec.axis_x.damping, spec.axis_y.damping)) {
  const double tau = (spec.delay + 1.0) * period;
  floor_ = kFloorFactor * std::min(spec.axis_x.mass, spec.axis_y.mass) / (tau * tau);
}

void ReversalLimiter::reset() noexcept {
  fraction_ = 1.0;
  floor_count_ = 0;
  is_exhausted_ = false;
  for (Axis& axis : axis_) {
    axis.count = 0;
    axis.lasted = 0;
  }
}

bool ReversalLimiter::update(glm::dvec2 position, bool in_contact, double wanted, double damping,
                             glm::dvec2 vibration) noexcept {
  time_ += period_;
  if (in_contact) last_contact_ = time_;
  track_vibration(vibration);
  const bool chatter_x = detect_chatter(axis_[0], position.x, wanted, damping);
  const bool chatter_y = detect_chatter(axis_[1], position.y, wanted, damping);
  const bool at_wall = time_ - last_contact_ < kContactWindow;
  if (!at_wall || (!chatter_x && !chatter_y)) return false;
  return soften(wanted);
}

bool ReversalLimiter::Swing::reverses(double value, double back) noexcept {
  const double ahead = direction * (value - farthest);
  if (ahead > 0.0) farthest = value;
  if (ahead > -back) return false;
  width = std::abs(farthest - last_turn);
  last_turn = farthest;
  farthest = value;
  direction = -direction;
  return true;
}

// Per period, a wall of stiffness K and damping B that responds late feeds at most pi |K + j B w| X^2 into a swing of
// amplitude X at angular frequency w, and the lever's own damping b dissipates pi b w X^2. So a wall of less than b w
// sustains no swing.
bool ReversalLimiter::detect_chatter(Axis& axis, double position, double wanted, double damping) noexcept {
  if (!axis.lever.reverses(position, reversal_step_) || is_forced_turn(axis)) return false;
  if (axis.lever.width < kTremorWidth) axis.narrow_time = time_;
  const double window = time_ - axis.narrow_time < kNarrowTime ? kTremorWindow : kReversalWindow;
  axis.reversal_widths[axis.count % kReversals] = axis.lever.width;
  axis.reversal_times[axis.count++ % kReversals] = time_;
  const double duration = time_ - axis.reversal_times[axis.count % kReversals];
  const double omega = std::numbers::pi * (kReversals - 1) / duration;
  const bool can_sustain = std::hypot(wanted, damping * omega) > damping_ * omega;
  const bool is_fast = axis.count >= kReversals && duration < window && can_sustain;
  if (is_fast && axis.lasted == 0) axis.first_width = widest(axis);
  if (axis.count >= kReversals) axis.lasted = is_fast ? axis.lasted + 1 : 0;
  const bool lasts = axis.lasted > kMaxStruckTurns && widest(axis) > kDying * axis.first_width;
  return is_fast && (lasts || !is_dying(axis));
}

double ReversalLimiter::widest(const Axis& axis) noexcept {
  return *std::max_element(axis.reversal_widths.begin(), axis.reversal_widths.end());
}

bool ReversalLimiter::is_dying(const Axis& axis) noexcept {
  double widest = 0.0;
  for (std::size_t i = 0; i < kReversals; ++i) {
    const double width = axis.reversal_widths[(axis.count + i) % kReversals];  // from the oldest to the newest
    if (width < kDying * widest) return true;
    widest = std::max(widest, width);
  }
  return false;
}

// Computes the widest swing that the vibration can cause. Per period, a force of amplitude F at angular frequency w
// feeds at most pi F X into a swing of amplitude X, and the lever's own damping b dissipates pi b w X^2. So X <= F / (b
// w) while all walls are passive, and a wider swing gets its energy from a wall. A vibration along one axis moves the
// tip along both axes, because the yoke couples them in the corners.
void ReversalLimiter::track_vibration(glm::dvec2 vibration) noexcept {
  const bool is_pending = axis_[0].pending_turns + axis_[1].pending_turns > 0;
  const bool is_same = vibration.x == vibration_[0].farthest && vibration.y == vibration_[1].farthest;
  if (is_same && !is_pending) return;  // in nearly every cycle
  const bool is_over = time_ - last_vibration_turn_ > kVibrationTimeout;
  for (Axis& axis : axis_) axis.pending_turns = is_over ? 0 : axis.pending_turns;
  for (int i = 0; i < 2; ++i) {
    Swing& swing = vibration_[static_cast<std::size_t>(i)];
    if (!swing.reverses(vibration[i], kMinVibration)) continue;
    const double omega = std::numbers::pi / std::clamp(time_ - last_vibration_turn_, period_, kVibrationTimeout);
    max_forced_swing_ = kVibrationMargin * swing.width / (damping_ * omega);
    last_vibration_turn_ = time_;
    for (Axis& axis : axis_) axis.pending_turns = std::min(axis.pending_turns + 1, kMaxPendingTurns);
  }
}

// True if this reversal of the lever is explained by a reversal of the vibration that has not yet explained another
// one.
bool ReversalLimiter::is_forced_turn(Axis& axis) noexcept {
  if (axis.pending_turns == 0 || axis.lever.width > max_forced_swing_) return false;
  --axis.pending_turns;
  return true;
}

bool ReversalLimiter::soften(double wanted) noexcept {
  for (Axis& axis : axis_) axis.count = 0;
  if (time_ - last_chatter_ > kCalmTime) floor_count_ = 0;
  last_chatter_ = time_;
  const double floor = wanted > floor_ ? floor_ / wanted : 1.0;
  if (fraction_ > floor) {
    fraction_ = std::max(floor, kSoftening * fraction_);
    return true;
  }
  if (++floor_count_ <= kMaxBounces || is_exhausted_) return false;
  fraction_ *= kSofteningBelowFloor;
  is_exhausted_ = fraction_ < kMinFraction;
  return true;
}

}  // namespace gearshift::haptics
