#include "haptics/analysis/passivity.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "haptics/files/range_check.h"

namespace gearshift::haptics {
namespace {

using Complex = std::complex<double>;

constexpr double kMinAngle = 1e-4;  // [rad] smallest angle searched
// [rad] Largest step between the angles searched. Delay (up to 15 samples) and velocity window (up to 64) give the
// function at most 79 ripples per 2 pi, so the step covers each ripple with at least 25 points.
constexpr double kMaxAngleStep = std::numbers::pi / 1024.0;

// Right side of eq (13) at an angle [rad] = angular frequency * period. The rewritten form 1 - exp(-j a) = 2 sin(a/2)
// (sin(a/2) + j cos(a/2)) avoids cancellation at small angles a.
double demand_at(const Environment& environment, double period, double angle) {
  const Complex e = environment(std::polar(1.0, angle));
  return 0.5 * period * (e.real() - e.imag() / std::tan(0.5 * angle));
}

// Golden-section search for the maximum of f between two angles. f must have a single peak between them.
template <typename Function>
double peak(const Function& f, double low, double high) {
  constexpr double kInverseGoldenRatio = 1.0 / std::numbers::phi;
  double best = f(high);
  while (high - low > 1e-9) {
    const double left = high - kInverseGoldenRatio * (high - low), right = low + kInverseGoldenRatio * (high - low);
    const double at_left = f(left), at_right = f(right);
    best = std::max({best, at_left, at_right});
    (at_left < at_right ? low : high) = at_left < at_right ? left : right;
  }
  return best;
}

// Largest value of an even function between the angles 0 and pi. The limit at 0 is included, because it can be the
// maximum, for example for a delayed spring. A scan with a step fine enough to find every peak comes first; each peak
// is then refined.
template <typename Function>
double max_over_angles(const Function& f) {
  double best = (4.0 * f(kMinAngle) - f(2.0 * kMinAngle)) / 3.0;
  double previous = kMinAngle, here = kMinAngle, at_previous = f(kMinAngle), at_here = at_previous;
  while (here < std::numbers::pi) {
    const double next = std::min(std::numbers::pi, here + std::min(0.1 * here, kMaxAngleStep));
    const double at_next = f(next);
    if (at_here >= at_previous && at_here >= at_next) best = std::max(best, peak(f, previous, next));
    previous = std::exchange(here, next);
    at_previous = std::exchange(at_here, at_next);
  }
  return std::max(best, at_here);
}

// Largest passive stiffness K of the environment K * spring + rest.
double stiffness_limit_of(double device_damping, const Environment& spring, const Environment& rest, double period) {
  require_between("device.damping", device_damping, 0.0, 1e9, "N s/m");
  if (damping_demand(rest, period) >= device_damping) return 0.0;
  const double per_stiffness = max_over_angles([&](double angle) {
    return demand_at(spring, period, angle) / (device_damping - demand_at(rest, period, angle));
  });
  return 1.0 / per_stiffness;
}

}  // namespace

Environment impedance(double stiffness, double damping, double mass, double period) {
  return [=](Complex z) {
    const Complex rate = (1.0 - 1.0 / z) / period;
    return stiffness + rate * (damping + rate * mass);
  };
}

Environment delayed(Environment environment, int samples) {
  return [environment = std::move(environment), samples](Complex z) { return environment(z) * std::pow(z, -samples); };
}

Environment contact_environment(const ContactLaw& law, double period) {
  check_contact(law, period);
  if (law.hold == ContactHold::observer) throw std::invalid_argument("the observer hold has no transfer function E(z)");
  const double ahead = law.hold == ContactHold::zero_order ? 0.0 : period * (0.5 + law.delay);
  const double blend = -std::expm1(-period / law.smoothing);
  const auto wall = [=](Complex z) {
    const Complex rate = (1.0 - std::pow(z, -law.window)) / (law.window * period);
    const Complex smooth_rate = rate * blend / (1.0 - (1.0 - blend) / z);
    return law.stiffness * (1.0 + ahead * rate) + law.damping * rate + law.free_damping * smooth_rate;
  };
  return delayed(wall, law.delay);
}

double damping_demand(const Environment& environment, double period) {
  require_between("period", period, 1e-6, 1.0, "s");
  return max_over_angles([&](double angle) { return demand_at(environment, period, angle); });
}

double passive_stiffness_limit(double device_damping, double damping, double mass, int delay, double period) {
  require_between("wall.damping", damping, 0.0, 1e6, "N s/m");
  require_between("wall.mass", mass, 0.0, 1e6, "kg");
  require_between("delay", delay, 0, kMaxLoopDelay, "samples");
  return stiffness_limit_of(device_damping, delayed(impedance(1.0, 0.0, 0.0, period), delay),
                            delayed(impedance(0.0, damping, mass, period), delay), period);
}

double passive_stiffness_limit(double device_damping, const ContactLaw& law, double period) {
  ContactLaw spring = law, rest = law;
  spring.stiffness = 1.0;
  spring.damping = spring.free_damping = 0.0;
  rest.stiffness = 0.0;
  return stiffness_limit_of(device_damping, contact_environment(spring, period), contact_environment(rest, period),
                            period);
}

}  // namespace gearshift::haptics
