#include "haptics/device/smoothed_hand.h"

#include <glm/common.hpp>

#include "haptics/files/range_check.h"
#include "haptics/joystick/finite.h"

namespace gearshift::haptics {
namespace {

// The axis x'' + (2/tau) x' + x/tau^2 = f with time constant tau. It is critically damped, and f = target / tau^2
// drives it to the target.
AxisModel critically_damped(double tau) noexcept {
  return {1.0, 2.0 / tau, 1.0 / (tau * tau)};
}

constexpr double kMaxPosition = 1.0;  // [m] limits the target; farther than any lever moves

}  // namespace

SmoothedHand::SmoothedHand(LatestValue<HandTarget>& target, double period, double smoothing)
    : target_(target),
      filter_(critically_damped(require_between("SmoothedHand: smoothing", smoothing, 1e-3, 1.0, "s"))),
      stepper_(filter_, require_between("SmoothedHand: period", period, 1e-6, 1.0, "s")) {}

HandTarget SmoothedHand::next(double, glm::dvec2 lever) noexcept {
  if (!has_started_) {
    select_.position = lever.x;
    shift_.position = lever.y;
    latest_.position = lever;
    has_started_ = true;
  }
  target_.update();
  const HandTarget& newest = target_.value();
  if (is_finite(newest.position) && is_finite(newest.push)) latest_ = newest;
  latest_.position = glm::clamp(latest_.position, -kMaxPosition, kMaxPosition);

  select_ = stepper_.step(select_, filter_.stiffness * latest_.position.x);
  shift_ = stepper_.step(shift_, filter_.stiffness * latest_.position.y);
  HandTarget target = latest_;
  target.position = {select_.position, shift_.position};
  target.velocity = {select_.velocity, shift_.velocity};
  return target;
}

}  // namespace gearshift::haptics
