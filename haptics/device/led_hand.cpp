#include "haptics/device/led_hand.h"

#include <glm/common.hpp>

#include "haptics/device/checked.h"
#include "haptics/joystick/finite.h"

namespace gearshift {
namespace {

// x'' + (2/tau) x' + x/tau^2 = f: critically damped, and f = target / tau^2 leads it to the target.
AxisModel critically_damped(double tau) noexcept {
  return {1.0, 2.0 / tau, 1.0 / (tau * tau)};
}

constexpr double kFarthest = 1.0;  // [m] no lever is larger; keeps the filter's numbers sane

}  // namespace

LedHand::LedHand(LatestValue<HandTarget>& channel, double period, double smoothing)
    : channel_(channel),
      filter_(critically_damped(require_between("LedHand: smoothing", smoothing, 1e-3, 1.0, "s"))),
      stepper_(filter_, require_between("LedHand: period", period, 1e-6, 1.0, "s")) {}

HandTarget LedHand::next(double, glm::dvec2 lever) noexcept {
  if (!holds_) {
    select_.position = lever.x;
    shift_.position = lever.y;
    wanted_.position = lever;
    holds_ = true;
  }
  channel_.update();
  const HandTarget& newest = channel_.value();
  if (is_finite(newest.position) && is_finite(newest.push)) wanted_ = newest;
  wanted_.position = glm::clamp(wanted_.position, -kFarthest, kFarthest);

  select_ = stepper_.step(select_, filter_.stiffness * wanted_.position.x);
  shift_ = stepper_.step(shift_, filter_.stiffness * wanted_.position.y);
  HandTarget target = wanted_;
  target.position = {select_.position, shift_.position};
  target.velocity = {select_.velocity, shift_.velocity};
  return target;
}

}  // namespace gearshift
