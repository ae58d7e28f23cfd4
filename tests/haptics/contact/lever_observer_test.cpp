// Checks that the observer tracks the plant it models, and that the hold based on the observer conserves energy.
#include "haptics/contact/lever_observer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "haptics/contact/virtual_coupling.h"
#include "haptics/joystick/plant.h"

using namespace gearshift::haptics;

TEST_CASE("Ackermann: the error obeys (z - p)^3 = 0, p = exp(-bandwidth T), from any start (Cayley-Hamilton)") {
  for (const double period : {0.00025, 0.001, 0.005}) {
    for (const AxisModel& axis : {kPaperAxisX, AxisModel{0.1, 0.0, 0.0}, AxisModel{0.5, 0.2, 300.0}}) {
      const AxisObserver observer(axis, period);
      const ObserverGain gain = observer_gain(axis, 500.0, period);
      const AxisStepper plant(axis, period);
      AxisState truth{0.01, 0.3};
      AxisEstimate estimate{0.0, 0.0, 4.0};
      const double hand = -2.0, p = std::exp(-500.0 * period);
      std::vector<double> error;
      for (int n = 0; n < 12; ++n) {
        const double motor = 3.0 * std::sin(0.7 * n);
        truth = plant.step(truth, motor + hand);
        estimate = AxisObserver::correct(observer.predict(estimate, motor), gain, truth.position);
        error.push_back(estimate.position - truth.position);
      }
      double scale = 0.0;
      for (const double e : error) scale = std::max(scale, std::abs(e));
      for (std::size_t n = 3; n < error.size(); ++n) {
        const double expected = 3.0 * p * error[n - 1] - 3.0 * p * p * error[n - 2] + p * p * p * error[n - 3];
        CHECK(std::abs(error[n] - expected) < 1e-9 * scale);
      }
    }
  }
}

// The device's delay includes the wait for its next sample.
TEST_CASE(
    "with an exact model it predicts the lever at the moment when the next command acts, at any delay and interval") {
  constexpr double kPeriod = 0.001;
  for (int delay = 0; delay <= 8; ++delay) {
    // Lost readings are no longer interval: the last case loses one of three.
    for (const auto& [every, loses] : {std::pair{1, false}, {2, false}, {4, false}, {8, false}, {1, true}}) {
      CAPTURE(delay);
      CAPTURE(every);
      CAPTURE(loses);
      DeviceSpec spec;
      spec.delay = delay + every - 1;
      LeverObserver observer(spec, kPeriod);
      const AxisStepper x(spec.axis_x, kPeriod), y(spec.axis_y, kPeriod);
      const auto command = [](int n) {
        return n < 0 ? glm::dvec2{0.0} : glm::dvec2{std::sin(0.03 * n), std::cos(0.05 * n)};
      };
      AxisState select{0.002, 0.0}, shift{-0.001, 0.0};
      std::vector<glm::dvec2> at, predicted_begin, predicted_end;
      const glm::dvec2 hand{1.5, -0.7};
      LeverMotion motion;
      for (int n = 0; n < 1200; ++n) {
        motion.fresh = n % every == 0 && (!loses || n % 3 != 2);
        if (motion.fresh) motion.position = {select.position, shift.position};
        const ObservedMotion predicted = observer.update(motion, command(n - 1));
        at.emplace_back(select.position, shift.position);
        predicted_begin.push_back(predicted.position);
        // Predicted position at the end of the hold that starts at cycle n + delay. `predicted.end` excludes the motors,
        // so their effect is added.
        predicted_end.push_back(predicted.end + predicted.compliance * command(n));
        const glm::dvec2 force = command(n - delay) + hand;
        select = x.step(select, force.x);
        shift = y.step(shift, force.y);
      }
      for (std::size_t i = 1000; i < 1180; ++i) {
        const std::size_t begin = i + static_cast<std::size_t>(delay);
        CHECK(predicted_begin[i].x == doctest::Approx(at[begin].x).epsilon(1e-6));
        CHECK(predicted_begin[i].y == doctest::Approx(at[begin].y).epsilon(1e-6));
        CHECK(predicted_end[i].x == doctest::Approx(at[begin + 1].x).epsilon(1e-6));
        CHECK(predicted_end[i].y == doctest::Approx(at[begin + 1].y).epsilon(1e-6));
      }
    }
  }
}

namespace {

// A handle of known state hits a wall that uses the solved hold. Returns the energy supplied by the wall, as a fraction
// of the impact energy.
double wall_energy_fraction(const AxisModel& axis, const Coupling& wall, double speed, double phase) {
  const AxisStepper plant(axis, wall.period);
  const double compliance = plant.step({}, 1.0).position;
  AxisState lever{-phase * speed * wall.period, speed};
  double energy = 0.0;
  bool entered = false;
  for (int n = 0; n < 20000; ++n) {
    const double force = -solved_force(wall, lever.position, plant.step(lever, 0.0).position, compliance);
    const AxisState next = plant.step(lever, force);
    energy += force * (next.position - lever.position);
    lever = next;
    entered = entered || lever.position > 0.0;
    if (entered && lever.position < 0.0) break;
  }
  return energy / (0.5 * axis.mass * speed * speed);
}

}  // namespace

// The observer assumes that the hand's push stays constant. If the stick is unplugged while a hand pushes with 20 N
// against a wall, the unopposed push would move the model by metres, so the model must stop.
TEST_CASE("without samples it stays at the last one, and restarts at the next") {
  constexpr double kPeriod = 0.001;
  DeviceSpec spec;
  spec.delay = 3;
  LeverObserver observer(spec, kPeriod);
  LeverMotion motion;
  motion.position = {0.02, 0.01};
  motion.fresh = true;
  for (int n = 0; n < 300; ++n) observer.update(motion, {-20.0, 0.0});  // at rest, because the hand balances the motors
  motion.fresh = false;
  ObservedMotion predicted;
  for (int n = 0; n < 1000; ++n) predicted = observer.update(motion, {0.0, 0.0});
  CHECK(predicted.position.x == doctest::Approx(0.02).epsilon(0.01));
  motion.position = {0.05, -0.03};
  motion.fresh = true;
  predicted = observer.update(motion, {0.0, 0.0});
  CHECK(predicted.position.x == doctest::Approx(0.05).epsilon(0.01));
  CHECK(predicted.position.y == doctest::Approx(-0.03).epsilon(0.01));
}

TEST_CASE("solved hold, exact model, no damping: the wall returns what it absorbed, to rounding, at any K and T") {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (const double period : {0.01, 0.005, 0.001, 0.00025}) {
    for (const double stiffness : {300.0, 5000.0, 100000.0}) {
      for (int i = 0; i < 50; ++i) {
        const Coupling wall{stiffness, 0.0, period};
        CHECK(std::abs(wall_energy_fraction(kPaperAxisX, wall, 0.1 + unit(random), unit(random))) < 1e-12);
      }
    }
  }
  // With damping, the wall absorbs more than 30 % of the impact energy. For comparison: a zero-order spring supplies
  // 33 % extra energy at 1 ms (energy_control_test).
  CHECK(wall_energy_fraction(kPaperAxisX, {5000.0, 50.0, 0.001}, 0.3, 0.5) < -0.3);
}

TEST_CASE("solved force: continuous where the lever begins at the wall, and never pulls") {
  const Coupling wall{5000.0, 50.0, 0.001};
  const double compliance = 5e-6;
  for (const double end : {1e-5, 1e-4, 1e-3}) {
    const double outside = solved_force(wall, -1e-12, end, compliance),
                 inside = solved_force(wall, 1e-12, end, compliance);
    CHECK(outside == doctest::Approx(inside).epsilon(1e-6));
  }
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> place(-2e-3, 2e-3);
  for (int i = 0; i < 100000; ++i) REQUIRE(solved_force(wall, place(random), place(random), compliance) >= 0.0);
}
