// Tests of PidLever: position in metres and force in newtons from the calibration, for any counts and signs, and the
// buttons.
#include "haptics/hardware/pid_lever.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "tests/haptics/device/still_hand.h"
#include "tests/haptics/hardware/calibrated.h"
#include "tests/haptics/hardware/stick_bench.h"

using namespace gearshift::haptics;
using namespace gearshift::test;
using glm::dvec2;

namespace {

EmulatedStickConfig held_fast(StickFamily family) {
  EmulatedStickConfig config;
  config.family = family;
  config.lever.hand = {0.5, 50.0, 50'000.0};  // held firmly
  return config;
}

// A stick, its driver and its lever. cycle() reads the lever, writes a force and advances one period.
struct LeverBench : StickBench {
  LeverBench(const EmulatedStickConfig& config, const DeviceCalibration& known, HandDriver& hand)
      : StickBench(config, hand), lever((prepare(), known), driver, 0.001) {}

  LeverReading cycle(dvec2 force, int times = 1) {
    LeverReading reading;
    for (int i = 0; i < times; ++i) {
      reading = lever.read(now_ns);
      lever.write(force);
      tick();
    }
    return reading;
  }

  PidLever lever;
};

}  // namespace

TEST_CASE("counts to metres: linear on either side of the centre, and beyond the stops") {
  // The axis has 0 to 1000 counts, rests at 400 and travels 100 mm: the lower 50 mm have 400 counts, the upper 50 mm
  // have 600.
  const LeverAxisCalibration up{0x30, 0.0, 400.0, 1000.0, 0.1, 0.0, 0, 0, 0.0, {}};
  const LeverAxisCalibration down{0x30, 1000.0, 400.0, 0.0, 0.1, 0.0, 0, 0, 0.0, {}};
  const BitField field{0, 16, 0, 1000, 0};
  const LeverAxisMap rising(up, field), falling(down, field);
  CHECK(rising.metres(400.0) == 0.0);
  CHECK(rising.metres(0.0) == doctest::Approx(-0.05));
  CHECK(rising.metres(1000.0) == doctest::Approx(0.05));
  CHECK(rising.metres(700.0) == doctest::Approx(0.025));
  CHECK(rising.metres(1120.0) == doctest::Approx(0.06));
  CHECK(falling.metres(0.0) == doctest::Approx(0.05));
  CHECK(falling.metres(200.0) == doctest::Approx(0.025));
  CHECK(falling.metres(1000.0) == doctest::Approx(-0.05));
  for (double counts = -50.0; counts < 1050.0; counts += 12.5) {
    CHECK(rising.counts(rising.metres(counts)) == doctest::Approx(counts));
    CHECK(falling.counts(falling.metres(counts)) == doctest::Approx(counts));
  }
  CHECK(rising.deflection(0.0) == doctest::Approx(-0.2));  // count 400 of 0 to 1000, on a scale from -1 to 1
  CHECK(falling.deflection(0.05) == doctest::Approx(-1.0));
}

TEST_CASE("forces are used up to the measured magnitude, and without a motor for select along shift only") {
  StillHand hand;
  const EmulatedStickConfig config = held_fast(StickFamily::openffboard);
  DeviceCalibration known = calibration_of(config);
  for (LeverAxisCalibration* axis : {&known.select, &known.shift}) {
    axis->constant_limit = 0.5;
    axis->constant_slope = 0.8;  // 8 N at half magnitude, of 20 N
  }
  LeverBench bench(config, known, hand);
  CHECK(bench.lever.spec().max_force == dvec2(8.0));
  bench.cycle({4.0, 100.0}, 30);
  CHECK(std::abs(bench.driver.state().sent[0]) == doctest::Approx(0.25).epsilon(0.001));
  CHECK(std::abs(bench.driver.state().sent[1]) == doctest::Approx(0.5).epsilon(0.001));

  known.select_by_position = true;
  LeverBench shift(config, known, hand);
  CHECK(shift.lever.spec().max_force == dvec2(0.0, 8.0));
  shift.cycle({4.0, 4.0}, 30);
  CHECK(shift.driver.state().sent[0] == 0.0);
  CHECK(std::abs(shift.driver.state().sent[1]) == doctest::Approx(0.25).epsilon(0.001));
  CHECK(shift.stick.playing() == 1);
}

TEST_CASE("an unusable calibration is refused in one sentence") {
  StillHand hand;
  StickBench bench(held_fast(StickFamily::vjoy), hand);
  DeviceCalibration known = calibration_of(held_fast(StickFamily::vjoy));
  known.select.travel = 0.0;
  CHECK_THROWS_AS(PidLever(known, bench.driver, 0.001), std::invalid_argument);
  known = calibration_of(held_fast(StickFamily::sidewinder));
  known.shift.usage = 0x38;
  StickBench sidewinder(held_fast(StickFamily::sidewinder), hand);
  CHECK_THROWS_AS(PidLever(known, sidewinder.driver, 0.001), std::invalid_argument);
  known = calibration_of(held_fast(StickFamily::vjoy));
  known.timing.delay = 0.1;
  CHECK_THROWS_AS(PidLever(known, bench.driver, 0.001), std::invalid_argument);
}

TEST_CASE("position and force are right for every family and every polarity") {
  for (const StickFamily family : kStickFamilies) {
    for (const glm::ivec2 sign : {glm::ivec2(1, 1), glm::ivec2(-1, 1), glm::ivec2(1, -1), glm::ivec2(-1, -1)}) {
      CAPTURE(name_of(family));
      EmulatedStickConfig config = held_fast(family);
      config.constant_sign = sign;
      StillHand hand(hand_at({0.030, -0.045}));
      LeverBench bench(config, calibration_of(config), hand);
      bench.cycle(dvec2(0.0), 500);
      CHECK_FALSE(bench.stick.actuators_on());  // zero force leaves the motors off
      const LeverReading reading = bench.cycle({6.0, -11.0}, 200);
      CHECK(glm::distance(reading.position, bench.stick.position()) <
            0.6 * bench.lever.spec().position_step * std::sqrt(2.0));
      CHECK(glm::distance(bench.stick.force(), {6.0, -11.0}) < 0.06);
      CHECK(glm::distance(reading.actuator_force, {6.0, -11.0}) < 1e-9);
      CHECK(reading.sequence == 699);
      CHECK_FALSE(reading.stop);
      bench.cycle({400.0, -400.0}, 20);                                  // limited to the full force of 20 N
      CHECK(glm::distance(bench.stick.force(), {20.0, -20.0}) < 0.003);  // tolerance: vJoy rounds the force's direction
      bench.lever.release();
      bench.cycle(dvec2(0.0), 1);
      CHECK(bench.stick.force() == dvec2(0.0));
    }
  }
}

TEST_CASE("a stick turned by a quarter: its Y axis is select") {
  EmulatedStickConfig config = held_fast(StickFamily::openffboard);
  DeviceCalibration known = calibration_of(config);
  std::swap(known.select, known.shift);  // pushing the knob forward now moves the stick's X axis
  StillHand hand(hand_at({0.010, 0.030}));
  LeverBench bench(config, known, hand);
  const LeverReading reading = bench.cycle({5.0, 2.0}, 500);
  CHECK(reading.position.x == doctest::Approx(0.030).epsilon(0.02));
  CHECK(reading.position.y == doctest::Approx(0.010).epsilon(0.05));
  CHECK(glm::distance(bench.stick.force(), {2.0, 5.0}) < 0.01);
}

TEST_CASE("a destroyed lever leaves the motors off, and the next one drives them") {
  EmulatedStickConfig config = held_fast(StickFamily::sidewinder);
  StillHand hand;
  StickBench bench(config, hand);
  bench.prepare();
  for (int time = 0; time < 3; ++time) {
    {
      PidLever lever(calibration_of(config), bench.driver, 0.001);
      for (int i = 0; i < 50; ++i) {
        CHECK_FALSE(lever.read(bench.now_ns).stop);
        lever.write({8.0, 0.0});
        bench.tick();
      }
      CHECK(bench.stick.force().x == doctest::Approx(8.0).epsilon(0.01));
    }
    bench.tick();
    CHECK(bench.stick.force() == dvec2(0.0));
    for (int i = 0; i < 200; ++i) bench.tick();
    CHECK_FALSE(bench.stick.actuators_on());
  }
  CHECK(bench.problems().empty());
}

TEST_CASE("without measured polarity there is no force at all") {
  EmulatedStickConfig config = held_fast(StickFamily::vjoy);
  DeviceCalibration known = calibration_of(config);
  known.shift.constant_sign = 0;
  StillHand hand;
  LeverBench bench(config, known, hand);
  LeverWalls walls;
  walls.stiffness_fraction = 1.0;
  bench.lever.set_device_walls(walls);
  bench.cycle({20.0, 20.0}, 100);
  CHECK(bench.lever.spec().max_force == dvec2(0.0));
  CHECK(bench.lines().empty());
}

TEST_CASE("the motors are off before a force is commanded, and after a release until the next force") {
  EmulatedStickConfig config = held_fast(StickFamily::sidewinder);
  StillHand hand;
  LeverBench bench(config, calibration_of(config), hand);
  bench.cycle(dvec2(0.0), 200);
  CHECK(bench.lines().empty());
  bench.cycle({1.0, 0.0}, 20);
  bench.lever.release();
  bench.cycle(dvec2(0.0), 20);
  bench.stick.log.clear();
  bench.cycle(dvec2(0.0), 200);
  CHECK(bench.lines().empty());
  bench.cycle({0.0, 3.0}, 20);
  CHECK(bench.stick.force().y == doctest::Approx(3.0).epsilon(0.03));
}

// One PID spring condition (USB PID 1.0 section 5.3) makes the two walls of an aisle: its centre is the middle of the
// aisle, its dead band is half the aisle's width, and its coefficient is the wall stiffness.
TEST_CASE(
    "walls that the device keeps: nothing between them, a spring of share x stiffness beyond, whichever way it "
    "counts") {
  for (const StickFamily family : {StickFamily::openffboard, StickFamily::vjoy}) {
    for (const glm::ivec2 sign : {glm::ivec2(1, 1), glm::ivec2(-1, 1), glm::ivec2(-1, -1)}) {
      CAPTURE(name_of(family));
      CAPTURE(sign.x);
      EmulatedStickConfig config = held_fast(family);
      config.spring_sign = sign;
      StillHand hand(hand_at({0.020, 0.0}));
      LeverBench bench(config, calibration_of(config), hand);
      CHECK(bench.lever.spec().device_wall_stiffness == dvec2(400.0));
      LeverWalls walls{{-0.010, -0.040}, {0.030, 0.015}, 0.5};
      bench.lever.set_device_walls(walls);
      bench.cycle(dvec2(0.0), 200);
      CHECK(bench.stick.actuators_on());
      CHECK(glm::length(bench.stick.force()) < 1e-9);  // between the walls
      for (const dvec2 place : {dvec2{0.045, 0.0}, dvec2{-0.030, 0.0}, dvec2{0.0, 0.030}, dvec2{0.0, -0.055}}) {
        hand.target = hand_at(place);
        bench.cycle(dvec2(0.0), 300);
        const dvec2 there = bench.stick.position();
        const dvec2 expected = 0.5 * 400.0 * (glm::clamp(there, walls.low, walls.high) - there);
        CHECK(glm::distance(bench.stick.force(), expected) < 0.03);
        CHECK(glm::distance(bench.cycle(dvec2(0.0)).actuator_force, expected) < 0.03);
      }
      bench.lever.set_device_walls({});
      bench.cycle(dvec2(0.0), 20);
      CHECK(glm::length(bench.stick.force()) < 1e-9);
    }
  }
}

// A PID damper acts at every position, so the driver enables it only on the axis of a wall, and only while the lever is
// inside this wall.
TEST_CASE("a device damper brakes in a wall, with either polarity, and nowhere else") {
  for (const int sign : {1, -1}) {
    CAPTURE(sign);
    EmulatedStickConfig config = held_fast(StickFamily::openffboard);
    config.damper_sign = {sign, sign};
    StillHand hand;
    LeverBench bench(config, calibration_of(config), hand);
    CHECK(bench.lever.spec().device_wall_damping == dvec2(20.0));
    LeverWalls walls{{-0.050, -0.050}, {0.005, 0.050}, 0.0, 0.5};
    bench.lever.set_device_walls(walls);
    bench.cycle(dvec2(1e-3, 0.0), 200);
    double worst = 0.0, strongest = 0.0;
    for (int ms = 0; ms < 1000; ++ms) {
      hand.target = hand_at({0.020 * std::sin(4e-3 * std::numbers::pi * ms), 0.0});  // a motion at 2 Hz, up to 0.25 m/s
      const dvec2 before = bench.stick.position();
      bench.cycle(dvec2(1e-3, 0.0));
      const dvec2 now = bench.stick.position();
      const double expected = before.x > 0.0052 ? -0.5 * 20.0 * (now.x - before.x) / 0.001 : 0.0;
      if (std::abs(now.x - 0.005) < 0.002) continue;  // skips positions near the wall's edge, where damping switches
      worst = std::max(worst, std::abs(bench.stick.force().x - expected));
      strongest = std::max(strongest, std::abs(expected));
      CHECK(std::abs(bench.stick.force().y) < 1e-9);
    }
    CHECK(strongest > 1.5);
    CHECK(worst < 0.15);
  }
}

TEST_CASE("springs that push away and cannot be inverted, or were not measured, make no device walls") {
  StillHand hand;
  EmulatedStickConfig config = held_fast(StickFamily::vjoy);
  DeviceCalibration known = calibration_of(config);
  known.shift.spring_sign = 0;
  StickBench bench(config, hand);
  CHECK(PidLever(known, bench.driver, 0.001).spec().device_wall_stiffness == dvec2(0.0));
}

TEST_CASE("buttons: push-down, lift, stop; a stop button held at the start is ignored until released") {
  EmulatedStickConfig config = held_fast(StickFamily::sidewinder);
  StillHand hand;
  LeverBench bench(config, calibration_of(config), hand);
  bench.stick.held_buttons = 0b0100;
  CHECK_FALSE(bench.cycle(dvec2(0.0), 5).stop);
  bench.stick.held_buttons = 0b0011;
  const LeverReading both = bench.cycle(dvec2(0.0), 5);
  CHECK(both.pressed_down);
  CHECK(both.lifted);
  CHECK_FALSE(both.stop);
  bench.stick.held_buttons = 0b0100;
  const LeverReading stop = bench.cycle(dvec2(0.0), 5);
  CHECK(stop.stop);
  CHECK_FALSE(stop.pressed_down);
}

TEST_CASE("after a reconnect one reading has stop set, and the loop's command of that cycle drives nothing") {
  EmulatedStickConfig config = held_fast(StickFamily::vjoy);
  StillHand hand;
  LeverBench bench(config, calibration_of(config), hand);
  bench.cycle({5.0, 5.0}, 100);
  bench.stick.unplug();
  bench.prepare();
  int stops = 0;
  for (int i = 0; i < 50; ++i) {
    const LeverReading reading = bench.lever.read(bench.now_ns);
    stops += reading.stop ? 1 : 0;
    bench.lever.write(reading.stop ? dvec2{5.0, 5.0} : dvec2(0.0));  // like a loop that reacts to the stop a cycle late
    bench.tick();
    CHECK_FALSE(bench.stick.actuators_on());
  }
  CHECK(stops == 1);
  bench.cycle({5.0, 5.0}, 20);
  CHECK(bench.stick.force().x == doctest::Approx(5.0).epsilon(0.01));
}
