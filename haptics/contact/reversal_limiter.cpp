#include "haptics/contact/reversal_limiter.h"

#include <algorithm>

namespace gearshift {
namespace {

constexpr double kTurn = 4.0;          // [counts] back from an extreme: more than the encoder makes by itself
constexpr double kLeastStep = 20e-6;   // [m] taken for a count where the encoder is finer
constexpr double kWithin = 0.25;       // [s] that the reversals fall into
constexpr double kPause = 0.5;         // [s] without chatter: it had calmed
constexpr double kLower = 0.75;        // [1] of the stiffness, each time
constexpr double kFloor = 0.3;         // [1] of m / tau^2, tau = (delay + 1) T
constexpr int kBounces = 3;            // times at the floor that may be a bounce dying away
constexpr double kLowerBelow = 0.5;    // [1] of the stiffness, each further time
constexpr double kLeast = 1.0 / 64.0;  // [1] of the stiffness: beyond softening

}  // namespace

ReversalLimiter::ReversalLimiter(const DeviceSpec& spec, double period) noexcept
    : period_(period), turn_(kTurn * std::max(spec.position_step, kLeastStep)) {
  const double tau = (spec.delay + 1.0) * period;
  floor_ = kFloor * std::min(spec.axis_x.mass, spec.axis_y.mass) / (tau * tau);
}

void ReversalLimiter::reset() noexcept {
  share_ = 1.0;
  at_floor_ = 0;
  exhausted_ = false;
  for (Axis& axis : axis_) axis.count = 0;
}

bool ReversalLimiter::update(glm::dvec2 position, bool touches, double wanted) noexcept {
  now_ += period_;
  if (touches) touched_ = now_;
  const bool chatter_x = chatters(axis_[0], position.x);
  const bool chatter_y = chatters(axis_[1], position.y);
  const bool at_wall = now_ - touched_ < kWithin;
  if (!at_wall || (!chatter_x && !chatter_y)) return false;
  return lower(wanted);
}

bool ReversalLimiter::chatters(Axis& axis, double position) noexcept {
  const double ahead = axis.direction * (position - axis.extreme);
  if (ahead > 0.0) axis.extreme = position;
  if (ahead > -turn_) return false;
  axis.extreme = position;
  axis.direction = -axis.direction;
  axis.turned[axis.count++ % kReversals] = now_;
  const double first = axis.turned[axis.count % kReversals];  // of the last kReversals
  return axis.count >= kReversals && now_ - first < kWithin;
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
