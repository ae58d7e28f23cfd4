#include "haptics/contact/reversal_limiter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gearshift {
namespace {

constexpr double kTurn = 4.0;          // [counts] back from an extreme: more than the encoder makes by itself
constexpr double kLeastStep = 20e-6;   // [m] taken for a count where the encoder is finer
constexpr double kWithin = 0.25;       // [s] that the reversals fall into: 10 Hz
constexpr double kTremor = 0.8e-3;     // [m] from turn to turn: as wide as a hand's tremor swings a lever
constexpr double kFaster = 0.2;        // [s] that they fall into if one is no wider: 12.5 Hz, faster than any tremor
constexpr double kShakeLasts = 0.25;   // [s] after its last turn; slower than 2 Hz it is taken for 2 Hz
constexpr double kPause = 0.5;         // [s] without chatter: it had calmed
constexpr double kLower = 0.75;        // [1] of the stiffness, each time
constexpr double kFloor = 0.3;         // [1] of m / tau^2, tau = (delay + 1) T
constexpr int kBounces = 3;            // times at the floor that may be a bounce dying away
constexpr double kLowerBelow = 0.5;    // [1] of the stiffness, each further time
constexpr double kLeast = 1.0 / 64.0;  // [1] of the stiffness: beyond softening
constexpr double kLeastShake = 0.02;   // [N] back from an extreme: less moves no lever by four counts
constexpr double kMargin = 1.25;       // [1] over what a sine would do: no shake is one
constexpr int kMostShakes = 2;         // that the lever may be behind: a turn either way

}  // namespace

ReversalLimiter::ReversalLimiter(const DeviceSpec& spec, double period) noexcept
    : period_(period),
      turn_(kTurn * std::max(spec.position_step, kLeastStep)),
      damping_(std::min(spec.axis_x.damping, spec.axis_y.damping)) {
  const double tau = (spec.delay + 1.0) * period;
  floor_ = kFloor * std::min(spec.axis_x.mass, spec.axis_y.mass) / (tau * tau);
}

void ReversalLimiter::reset() noexcept {
  share_ = 1.0;
  at_floor_ = 0;
  exhausted_ = false;
  for (Axis& axis : axis_) axis.count = 0;
}

bool ReversalLimiter::update(glm::dvec2 position, bool touches, double wanted, glm::dvec2 shake) noexcept {
  now_ += period_;
  if (touches) touched_ = now_;
  watch_shake(shake);
  const bool chatter_x = chatters(axis_[0], position.x);
  const bool chatter_y = chatters(axis_[1], position.y);
  const bool at_wall = now_ - touched_ < kWithin;
  if (!at_wall || (!chatter_x && !chatter_y)) return false;
  return lower(wanted);
}

bool ReversalLimiter::Swing::turns(double value, double back) noexcept {
  const double ahead = direction * (value - farthest);
  if (ahead > 0.0) farthest = value;
  if (ahead > -back) return false;
  width = std::abs(farthest - turned_at);
  turned_at = farthest;
  farthest = value;
  direction = -direction;
  return true;
}

bool ReversalLimiter::chatters(Axis& axis, double position) noexcept {
  if (!axis.lever.turns(position, turn_) || is_shaken(axis)) return false;
  if (axis.lever.width < kTremor) axis.narrow = now_;
  const double within = now_ - axis.narrow < kWithin ? kFaster : kWithin;
  axis.turned[axis.count++ % kReversals] = now_;
  const double first = axis.turned[axis.count % kReversals];  // of the last kReversals
  return axis.count >= kReversals && now_ - first < within;
}

// Whatever the lever stands in, a force of amplitude F at w feeds at most pi F X a period into a swing of X, and the lever's
// own damping takes pi b w X^2 of it: X <= F / (b w). What swings wider is fed by its wall.
// A shake along one axis moves the tip along both: the yoke turns them into each other in the corners.
void ReversalLimiter::watch_shake(glm::dvec2 shake) noexcept {
  const bool is_over = now_ - shaken_ > kShakeLasts;
  for (Axis& axis : axis_) axis.shakes = is_over ? 0 : axis.shakes;
  for (int i = 0; i < 2; ++i) {
    Swing& swing = shake_[static_cast<std::size_t>(i)];
    if (!swing.turns(shake[i], kLeastShake)) continue;
    const double omega = std::numbers::pi / std::clamp(now_ - shaken_, period_, kShakeLasts);
    shaken_by_ = kMargin * swing.width / (damping_ * omega);
    shaken_ = now_;
    for (Axis& axis : axis_) axis.shakes = std::min(axis.shakes + 1, kMostShakes);
  }
}

// Does a turn of the shake answer for this one of the lever? Each does for one.
bool ReversalLimiter::is_shaken(Axis& axis) noexcept {
  if (axis.shakes == 0 || axis.lever.width > shaken_by_) return false;
  --axis.shakes;
  return true;
}

bool ReversalLimiter::lower(double wanted) noexcept {
  for (Axis& axis : axis_) axis.count = 0;
  if (now_ - chattered_ > kPause) at_floor_ = 0;
  chattered_ = now_;
  const double floor = wanted > floor_ ? floor_ / wanted : 1.0;
  if (share_ > floor) {
    share_ = std::max(floor, kLower * share_);
    return true;
  }
  if (++at_floor_ <= kBounces || exhausted_) return false;
  share_ *= kLowerBelow;
  exhausted_ = share_ < kLeast;
  return true;
}

}  // namespace gearshift
