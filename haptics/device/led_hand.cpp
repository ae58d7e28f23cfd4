#include "haptics/device/led_hand.h"

#include <cmath>

#include <glm/common.hpp>

#include "haptics/device/checked.h"

namespace gearshift {
namespace {

// x'' + (2/tau) x' + x/tau^2 = f: critically damped, and f = target / tau^2 leads it to the target.
AxisModel critically_damped(double tau) noexcept {
  return {1.0, 2.0 / tau, 1.0 / (tau * tau)};
}

constexpr double kFarthest = 1.0;  // [m] no lever is larger; keeps the filter's numbers sane

bool finite(glm::dvec2 v) noexcept {
  return std::isfinite(v.x) && std::isfinite(v.y);
}

double checked_period(double period) {
  require_between("LedHand: period", period, 1e-6, 1.0, "s");
  return period;
}

double checked_smoothing(double smoothing) {
  require_between("LedHand: smoothing", smoothing, 1e-3, 1.0, "s");
  return smoothing;
}

}  // namespace

LedHand::LedHand(LatestValue<HandTarget>& channel, double period, double smoothing)
    : channel_(channel),
      filter_(critically_damped(checked_smoothing(smoothing))),
      stepper_(filter_, checked_period(period)) {}

HandTarget LedHand::next(double, glm::dvec2 lever) noexcept {
  if (!holds_) {
    select_.position = lever.x;
    shift_.position = lever.y;
    wanted_.position = lever;
    holds_ = true;
  }
  channel_.update();
  const HandTarget& newest = channel_.value();
  if (finite(newest.position) && finite(newest.push)) wanted_ = newest;
  wanted_.position = glm::clamp(wanted_.position, -kFarthest, kFarthest);

  select_ = stepper_.step(select_, filter_.stiffness * wanted_.position.x);
  shift_ = stepper_.step(shift_, filter_.stiffness * wanted_.position.y);
  HandTarget target = wanted_;
  target.position = {select_.position, shift_.position};
  target.velocity = {select_.velocity, shift_.velocity};
  return target;
}

}  // namespace gearshift
