// Tests of ForceWatch: a mass that a hand holds, in closed form, and sticks whose forces turn round.
#include "haptics/hardware/force_watch.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "haptics/loop/shift_script.h"
#include "tests/haptics/device/still_hand.h"
#include "tests/haptics/hardware/stick_loop.h"

using namespace gearshift::haptics;
using namespace gearshift::test;
using glm::dvec2;

namespace {

EmulatedStickConfig held_stick(const HandImpedance& hand) {
  EmulatedStickConfig config;
  config.family = StickFamily::openffboard;
  config.lever.hand = hand;
  return config;
}

// A tour through the gate, with the lowest slope of both axes.
struct Watched {
  Watched(const EmulatedStickConfig& stick_config, double delay)
      : config(stick_config),
        gate(stick_gate("six_speed_r_left_up", config)),
        start(rest_position(gate, kNeutralGear)),
        hand(script(), shift_strokes(gate, start, tour_order(gate)), config.plant_period),
        run((config.delay = delay, config), calibration_of(config), HapticConfig{}, gate, hand),
        watch(run.lever.spec(), delay + 0.0005, 0.001) {
    run.stick.logs = false;
    run.loop.arm();
  }
  ScriptedHandConfig script() const {
    ScriptedHandConfig made = touring_hand(start);
    made.effort_limit = 8.0;
    return made;
  }
  void cycle() {
    run.cycle();
    if (!run.stick.actuators_on()) return watch.reset();
    watch.update(run.loop.snapshot().lever, -run.loop.snapshot().f_a, 0.001);
    for (int i = 0; i < 2; ++i) {
      if (watch.slope(i) < lowest) {
        lowest = watch.slope(i);
        correlation = watch.correlation(i);
      }
    }
  }
  double duration() const { return hand.duration(); }

  EmulatedStickConfig config;
  Gate gate;
  dvec2 start;
  ScriptedHand hand;
  StickLoop run;
  ForceWatch watch;
  double lowest = 0.0, correlation = 0.0;  // lowest slope, and the correlation then
};

}  // namespace

// A force u = sin(w t) on the mass m + M, of which the watch knows m: m a = u m / (m + M), in phase with u, with slope m / (m + M).
TEST_CASE("motion that a force causes follows it, by the share of the known mass") {
  constexpr double kMass = 0.1, kPeriod = 0.001;
  DeviceSpec spec;
  spec.workspace = dvec2(1.0);
  spec.axis_x = {kMass, 0.0, 0.0};
  spec.axis_y = {2.0 * kMass, 0.0, 0.0};
  for (const double hand : {0.0, 0.5, 2.5}) {
    for (const double sign : {1.0, -1.0}) {
      for (const double frequency : {8.0, 15.0, 30.0}) {
        CAPTURE(hand);
        CAPTURE(sign);
        CAPTURE(frequency);
        ForceWatch watch(spec, 0.0, kPeriod);
        const double rate = 2.0 * std::numbers::pi * frequency;
        for (int i = 0; i < 3000; ++i) {
          const double u = 5.0 * std::sin(rate * kPeriod * i), scale = -sign / (rate * rate);
          watch.update(scale * u * dvec2(1.0 / (kMass + hand), 1.0 / (2.0 * kMass + hand)), dvec2(u), kPeriod);
        }
        CHECK(watch.correlation(0) == doctest::Approx(sign).epsilon(0.05));
        CHECK(watch.slope(0) == doctest::Approx(sign * kMass / (kMass + hand)).epsilon(0.05));
        CHECK(watch.slope(1) == doctest::Approx(sign * 2.0 * kMass / (2.0 * kMass + hand)).epsilon(0.05));
      }
    }
  }
}

TEST_CASE("no false alarm on a tour, with any hand and delay") {
  for (const HandImpedance& hand :
       {kGripHand, kArmHand, HandImpedance{0.02, 2.0, 100.0}, HandImpedance{2.5, 20.0, 1500.0}}) {
    for (const double delay : {0.0, 0.002, 0.005}) {
      CAPTURE(hand.mass);
      CAPTURE(delay);
      Watched tour(held_stick(hand), delay);
      while (tour.run.time() < tour.duration()) tour.cycle();
      CHECK(tour.lowest > -0.04);
      MESSAGE("hand of ", hand.mass, " kg, delay ", 1e3 * delay, " ms: lowest slope ", tour.lowest, ", correlation ",
              tour.correlation);
      CHECK(tour.run.problems().empty());
    }
  }
}

// Found in real time: a hand that presses on through a wall speeds up while the wall's force grows against it.
TEST_CASE("no false alarm when a hand presses into a wall, slowly or fast") {
  double lowest = 0.0;
  for (const HandImpedance& grip :
       {kGripHand, kArmHand, HandImpedance{0.02, 2.0, 100.0}, HandImpedance{2.5, 20.0, 1500.0}}) {
    for (const double speed : {0.05, 0.1, 0.2, 0.5}) {  // [m/s]
      for (const double delay : {0.0, 0.003, 0.006}) {
        CAPTURE(grip.mass);
        CAPTURE(speed);
        CAPTURE(delay);
        EmulatedStickConfig config = held_stick(grip);
        config.delay = delay;
        StillHand hand(hand_at({0.012, 0.0}));
        StickLoop run(config, calibration_of(config), HapticConfig{}, stick_gate("six_speed_r_left_up", config), hand);
        run.stick.logs = false;
        ForceWatch watch(run.lever.spec(), delay + 0.0005, 0.001);
        run.loop.arm();
        run.cycle_for(0.7);
        for (int ms = 0; ms < 2000; ++ms) {
          const double turn = std::fmod(0.001 * speed * ms, 0.080);
          hand.target = hand_at({0.012, turn < 0.040 ? turn : 0.080 - turn});
          run.cycle();
          watch.update(run.loop.snapshot().lever, -run.loop.snapshot().f_a, 0.001);
          lowest = std::min({lowest, watch.slope(0), watch.slope(1)});
          CHECK_FALSE(watch.is_reversed());
        }
        CHECK(run.problems().empty());
      }
    }
  }
  MESSAGE("lowest slope ", lowest);
}

TEST_CASE("a stick whose forces turn round is switched off, and a message is shown each time") {
  std::string table = "readings every ms | turned at s | off after ms\n";
  for (const double interval : {0.001, 0.004, 0.008}) {
    for (const double turns_at : {0.8, 2.0, 3.0, 4.5}) {
      CAPTURE(interval);
      CAPTURE(turns_at);
      EmulatedStickConfig config = held_stick(kGripHand);
      config.input_interval = interval;
      Watched tour(config, 0.0);
      double off_at = 0.0;
      while (tour.run.time() < turns_at + 3.0) {
        tour.run.stick.faults.reversed = tour.run.time() >= turns_at;
        tour.cycle();
        if (off_at == 0.0 && tour.run.time() > turns_at && !tour.run.stick.actuators_on()) off_at = tour.run.time();
      }
      table += std::to_string(1e3 * interval) + " | " + std::to_string(turns_at) + " | " +
               (off_at > 0.0 ? std::to_string(1e3 * (off_at - turns_at)) : "not within 3 s") + '\n';
      CHECK((off_at > 0.0 || interval > 0.001));
      if (off_at == 0.0) continue;
      const auto problems = tour.run.problems();
      REQUIRE(problems.size() == 1);
      CHECK(problems[0].starts_with("the stick pushes the other way than when it was calibrated"));
      CHECK(tour.run.stick.force() == dvec2(0.0));
      tour.run.loop.arm();  // the person tries again, and the message is repeated
      tour.run.cycle_for(0.2);
      REQUIRE(tour.run.stick.actuators_on());
      for (int ms = 0; ms < 4000 && tour.run.stick.actuators_on(); ++ms) tour.cycle();
      CHECK(tour.run.problems().empty() == tour.run.stick.actuators_on());
    }
  }
  MESSAGE(table);
}
