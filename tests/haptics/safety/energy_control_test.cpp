// Tests of energy bounding and passivity control. The reference is the energy of a lever that is simulated exactly.
#include "haptics/safety/energy_control.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include <doctest/doctest.h>

#include "haptics/safety/force_guard.h"

using namespace gearshift::haptics;

namespace {

// Energy [J] that the damping b dissipates in one period under a constant force: the integral of b v^2, by Simpson's
// rule on 8 exact sub-steps.
double damped_energy(const AxisModel& axis, AxisState state, double force, double period) {
  constexpr int kParts = 8;
  double sum = 0.0;
  for (int i = 0; i <= kParts; ++i) {
    const double v = advance(axis, state, force, period * i / kParts).velocity;
    sum += (i == 0 || i == kParts ? 1.0 : i % 2 == 1 ? 4.0 : 2.0) * v * v;
  }
  return axis.damping * sum * period / (3.0 * kParts);
}

// Drives a lever with the force `wanted`, limited by energy bounding. Returns the maximum over time [J] of the energy
// supplied by the motors minus the energy dissipated by the damping.
double worst_surplus(const AxisModel& axis, const AxisModel& assumed, double period,
                     const std::function<double(AxisState)>& wanted) {
  const EnergyBounder bounder(assumed, 0, period);
  AxisState lever{0.0, 0.4};
  double last = 0.0, travel = 0.0, supplied = 0.0, dissipated = 0.0, worst = 0.0;
  for (int n = 0; n < 5000; ++n) {
    const double force = bounder.bound(wanted(lever), last, travel);
    dissipated += damped_energy(axis, lever, force, period);
    const AxisState next = advance(axis, lever, force, period);
    travel = next.position - lever.position;
    supplied += force * travel;
    lever = next;
    last = force;
    worst = std::max(worst, supplied - dissipated);
  }
  return worst;
}

}  // namespace

TEST_CASE("energy bounding: never supplies more than the handle's damping dissipates, whatever force is wanted") {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> force(-100.0, 100.0);
  const std::function<double(AxisState)> laws[] = {
      [](AxisState s) { return s.velocity > 0.0 ? 100.0 : -100.0; },               // a force in the direction of motion
      [](AxisState s) { return s.position > 0.0 ? -50000.0 * s.position : 0.0; },  // a wall that is far too stiff
      [&](AxisState) { return force(random); },
  };
  for (const double period : {0.01, 0.001, 0.00025}) {
    for (const auto& law : laws) {
      CHECK(worst_surplus(kPaperAxisX, kPaperAxisX, period, law) <= 1e-12);
      CHECK(worst_surplus(kPaperAxisY, kPaperAxisY, period, law) <= 1e-12);
    }
  }
  // Negative control: a bounder that assumes eight times the real damping supplies too much energy.
  AxisModel assumed = kPaperAxisX;
  assumed.damping *= 8.0;
  CHECK(worst_surplus(kPaperAxisX, assumed, 0.01, laws[0]) > 1e-4);
}

TEST_CASE("energy bounding displays half the passive stiffness 2 b / T of (14)") {
  const EnergyBounder bounder(kPaperAxisX, 0, 0.001);
  double last = 0.0;
  // The lever moves 1 mm, in 100 steps of 10 um, into a wall that asks for an unlimited force. The displayed stiffness
  // is the damping divided by the period, 3000 N/m.
  for (int n = 0; n < 100; ++n) last = bounder.bound(-1e9, last, 1e-5);
  CHECK(last == doctest::Approx(-3000.0 * 1e-3));
}

namespace {

// A free lever hits a wall that is a sampled spring of 5000 N/m. Returns the energy that the wall supplies, in % of the
// kinetic energy before the impact. The impact falls at different times within a sampling period; the result is the
// mean over 200 of them.
double impact_energy(double period, bool controlled) {
  double sum = 0.0;
  constexpr int kPhases = 200;
  for (int i = 0; i < kPhases; ++i) {
    PassivityController controller(kPaperAxisX, period);
    const double speed = 0.3;
    AxisState lever{-speed * period * (i + 0.5) / kPhases, speed};
    double last = 0.0, travel = 0.0, supplied = 0.0;
    bool entered = false;
    for (int n = 0; n < 4000; ++n) {
      const bool in_contact = lever.position > 0.0;
      if (entered && !in_contact) break;
      entered = entered || in_contact;
      double force = in_contact ? -5000.0 * lever.position : 0.0;
      if (controlled) force = controller.control(force, last, travel, in_contact);
      const AxisState next = advance(kPaperAxisX, lever, force, period);
      travel = next.position - lever.position;
      supplied += force * travel;
      last = force;
      lever = next;
    }
    sum += supplied / (0.5 * kPaperAxisX.mass * speed * speed);
  }
  return 100.0 * sum / kPhases;
}

}  // namespace

TEST_CASE("passivity control: impact energy at 5000 N/m with and without it agrees with an independent program") {
  CHECK(impact_energy(0.001, false) == doctest::Approx(33.0).epsilon(0.1));
  CHECK(impact_energy(0.002, false) == doctest::Approx(74.0).epsilon(0.1));
  CHECK(impact_energy(0.005, false) == doctest::Approx(231.0).epsilon(0.1));
  CHECK(impact_energy(0.001, true) < 5.0);
  CHECK(impact_energy(0.002, true) < 25.0);
  CHECK(impact_energy(0.005, true) < 210.0);
}

namespace {

GuardInput still_at(double x, double force) {
  GuardInput in;
  in.force = {force, 0.0};
  in.position = {x, 0.0};
  in.fresh = true;
  in.in_contact = true;
  return in;
}

}  // namespace

TEST_CASE("the guard bounds the command, and arming resets the travel since the last command") {
  GuardConfig config;
  config.ramp_time = 0.001;
  DeviceSpec spec;
  spec.workspace = {0.077, 0.069};
  ForceGuard guard(config, spec, 0.001, EnergyControl::energy_bounding);
  guard.arm();
  guard.guard(still_at(0.0, 0.0));
  // The lever moves 1 mm, in steps of 10 um, into a wall that asks for 30 N. The displayed stiffness is at most the
  // damping divided by the period, 3000 N/m.
  double force = 0.0;
  for (int n = 1; n <= 100; ++n) force = guard.guard(still_at(1e-5 * n, -30.0)).force.x;
  CHECK(force == doctest::Approx(-3.0));
  for (int n = 0; n < 30; ++n) {  // without fresh readings, the guard goes to the state `damped`
    GuardInput dead = still_at(1e-3, -30.0);
    dead.fresh = false;
    guard.guard(dead);
  }
  REQUIRE(guard.state() == GuardState::damped);
  for (int n = 0; n < 100; ++n) guard.guard(still_at(0.030, -30.0));  // meanwhile the lever moves 29 mm deeper
  guard.arm();
  CHECK(guard.guard(still_at(0.030, -30.0)).force.x == 0.0);
  CHECK(guard.guard(still_at(0.030, -30.0)).force.x == 0.0);
  // Negative control: without energy bounding, the guard commands the full force.
  ForceGuard open(config, spec, 0.001);
  open.arm();
  open.guard(still_at(0.0, -30.0));
  open.guard(still_at(0.0, -30.0));
  CHECK(open.guard(still_at(0.0, -30.0)).force.x == -30.0);
}

TEST_CASE("a lever that keeps chattering is damped, and only arming restores the force") {
  ForceGuard guard({}, {}, 0.001);
  guard.arm();
  guard.damp();
  CHECK(guard.state() == GuardState::damped);
  CHECK(guard.fault() == GuardFault::chatter);
  for (int n = 0; n < 30; ++n) guard.guard(still_at(0.0, -30.0));
  CHECK(guard.guard(still_at(0.0, -30.0)).force.x == 0.0);
}

TEST_CASE("energy bounding uses each axis's own model, and with delay half of (13)'s K (T/2 + d T)") {
  GuardConfig config;
  config.ramp_time = 0.001;
  config.slew = 100.0;
  for (const int delay : {0, 1, 3}) {
    DeviceSpec spec;
    spec.workspace = {0.077, 0.069};
    spec.delay = delay;
    spec.axis_y.damping = 5.0;
    ForceGuard guard(config, spec, 0.001, EnergyControl::energy_bounding);
    guard.arm();
    GuardInput in = still_at(0.0, 0.0);
    guard.guard(in);
    glm::dvec2 force{0.0};
    for (int n = 1; n <= 100; ++n) {
      in.position = {1e-5 * n, 1e-5 * n};
      in.force = {-30.0, -30.0};
      force = guard.guard(in).force;
    }
    const double passive = 1.0 / (0.001 * (0.5 + delay));  // [1/s] passive stiffness divided by damping, equation (13)
    CHECK(force.x == doctest::Approx(-0.5 * 3.0 * passive * 1e-3));
    CHECK(force.y == doctest::Approx(-0.5 * 5.0 * passive * 1e-3));
  }
}

TEST_CASE("energy bounding is not limited by the slew: a force that must drop drops within the cycle") {
  GuardConfig config;
  config.ramp_time = 0.001;
  config.slew = 0.5;
  ForceGuard guard(config, {}, 0.001, EnergyControl::energy_bounding);
  guard.arm();
  double position = 0.0;
  guard.guard(still_at(position, 0.0));
  for (int n = 0; n < 100; ++n) guard.guard(still_at(position -= 1e-4, 20.0));  // the force grows by 0.3 N per period
  double last = guard.guard(still_at(position, 20.0)).force.x;
  REQUIRE(last > 10.0);
  for (int n = 0; n < 4; ++n) {  // the lever returns at 1 m/s
    const double now = guard.guard(still_at(position += 1e-3, 20.0)).force.x;
    CHECK(std::abs(now) <= std::abs(last - 3000.0 * 1e-3) + 1e-9);
    last = now;
  }
}

TEST_CASE("passivity control: no damping out of contact, and every contact starts its own energy balance") {
  PassivityController controller(kPaperAxisX, 0.001);
  // 10 uJ supplied: at -0.1 m/s for 1 ms, a damping force of 0.1 N takes exactly these back.
  controller.control(0.0, 0.01, 1e-3, true);
  CHECK(controller.control(0.0, 0.0, -1e-4, true) == doctest::Approx(0.1));
  CHECK(controller.control(-1.0, 0.0, -1e-4, false) == -1.0);  // no damping outside the contact
  CHECK(controller.control(0.0, 0.0, -1e-4, true) == 0.0);     // nothing is left to take back
  // The damping is at most half the mass divided by the period, because stronger sampled damping would oscillate. The
  // lever moves at -1 m/s (1 mm per period).
  controller.control(0.0, 100.0, 1e-2, true);
  CHECK(controller.control(0.0, 0.0, -1e-3, true) == doctest::Approx(0.5 * 0.095 / 0.001 * 1.0));
}
