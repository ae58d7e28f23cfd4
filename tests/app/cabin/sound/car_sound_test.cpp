// The driveline's sounds: starter, stall, limiter, over-rev, grind.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include <doctest/doctest.h>

#include "app/cabin/sound/car_synth.h"
#include "tests/app/cabin/sound/cabin.h"

using namespace gearshift::cabin;
using namespace gearshift::engine;
using namespace gearshift::test;
using namespace gearshift::vehicle;

namespace {

constexpr double kRadPerRpm = std::numbers::pi / 30.0;

VehicleState dead(double rpm) {
  VehicleState car;
  car.engine_speed = rpm * kRadPerRpm;
  car.running = false;
  return car;
}

VehicleState cranked(double rpm) {
  VehicleState car = dead(rpm);
  car.cranking = true;
  return car;
}

VehicleState grinding(double difference, double power) {
  VehicleState car;
  car.grinding = true;
  car.dog_difference = difference;
  car.grind_power = power;
  return car;
}

std::vector<double> left_ear(Cabin& cabin, const VehicleState& car, double seconds = 2.0) {
  cabin.car = car;
  cabin.run(0.1);
  return left(cabin.run(seconds));
}

// The line at `frequency` [Hz] in the spectrum of the signal's power, divided by the stronger of its two neighbours.
double line_prominence(std::vector<double> x, double frequency) {
  for (double& v : x) v = v * v;
  return amplitude_at(x, frequency) / std::max(amplitude_at(x, 0.77 * frequency), amplitude_at(x, 1.27 * frequency));
}

bool silent(Cabin& cabin, const VehicleState& car) {
  cabin.car = car;
  cabin.run(0.5);  // long enough for the previous sound to end
  return peak(doubles(cabin.run(0.3))) == 0.0;
}

}  // namespace

TEST_CASE(
    "the starter whines at 130 / 60 Hz per rpm of the engine and pulses with its compressions, at 1 / 30 Hz per rpm") {
  Cabin cabin;
  for (const double rpm : {120.0, 200.0, 280.0}) {
    CAPTURE(rpm);
    const std::vector<double> x = left_ear(cabin, cranked(rpm));
    CHECK(strongest_line(x) == doctest::Approx(rpm * 130.0 / 60.0).epsilon(0.005));
    CHECK(line_prominence(x, rpm / 30.0) > 3.0);
  }
  CHECK(silent(cabin, dead(0.0)));
  Cabin without({.engine = false});
  CHECK(silent(without, cranked(200.0)));
}

TEST_CASE("a stall judders with the firings, 60 Hz at 400 rpm, lower and quieter with the speed, until it is silent") {
  Cabin cabin;
  double last_level = 1e9, last_tone = 1e9;
  for (const double rpm : {500.0, 400.0, 300.0, 200.0}) {
    VehicleState car = dead(rpm);
    car.stalled = true;
    car.shudder = std::min(1.0, rpm / 500.0);
    const std::vector<double> x = left_ear(cabin, car);
    CAPTURE(rpm);
    CHECK(strongest_line(x) == doctest::Approx(60.0 * rpm / 400.0).epsilon(0.01));
    CHECK(line_prominence(x, rpm / 30.0) > 3.0);
    CHECK(strongest_line(x) < last_tone);
    CHECK(rms(x) < last_level);
    last_tone = strongest_line(x);
    last_level = rms(x);
  }
  CHECK(silent(cabin, dead(0.0)));
}

TEST_CASE("a running engine judders only while it shudders") {
  Cabin one, other;
  VehicleState car = running(800.0, 0.2);
  const std::vector<double> idle = left_ear(one, car);
  car.shudder = 0.5;
  const std::vector<double> shaken = left_ear(other, car);
  // The judder was synthesised as 60 Hz at 400 rpm. At 800 rpm it is played twice as fast: 120 Hz.
  CHECK(amplitude_at(shaken, 120.0) > 3.0 * amplitude_at(idle, 120.0));
}

TEST_CASE("the limiter stutters 12 times per second while the fuel is cut and resumes, and not afterwards") {
  Cabin cabin;
  VehicleState car = running(6450.0, 0.0);
  const std::vector<double> calm = left_ear(cabin, car);
  CHECK(line_prominence(calm, kLimiterRate) < 3.0);
  cabin.run(0.1);
  std::vector<float> stereo;
  for (int frame = 0; frame < 180; ++frame) {  // the fuel is cut for 33 ms of every 100 ms
    cabin.car.fuel_cut = frame % 6 < 2;
    const std::vector<float> some = cabin.run(kFrame);
    stereo.insert(stereo.end(), some.begin(), some.end());
  }
  CHECK(line_prominence(left(stereo), kLimiterRate) > 4.0);
  CHECK(level(stereo) > 1.2 * rms(calm));
  CHECK(line_prominence(left_ear(cabin, car), kLimiterRate) < 3.0);
}

TEST_CASE("fuel that is cut in one of six frames gives a continuous stutter") {
  Cabin cabin;
  std::vector<float> stereo;
  for (int frame = 0; frame < 120; ++frame) {
    cabin.car = VehicleState{};  // the engine is stopped, so only the stutter sounds
    cabin.car.fuel_cut = frame % 6 == 0;
    const std::vector<float> some = cabin.run(kFrame);
    stereo.insert(stereo.end(), some.begin(), some.end());
  }
  const std::vector<double> x = left(stereo);
  const auto window = static_cast<std::size_t>(kSoundRate / kLimiterRate);
  double softest = 1e9;
  for (std::size_t n = window; n + window <= x.size(); n += window)
    softest = std::min(softest, peak(std::span(x).subspan(n, window)));
  CHECK(peak(x) > 0.005);
  CHECK(softest > 0.3 * peak(x));
}

TEST_CASE("over-rev sounds at 900 Hz, four times per second, from its first frame until one hold after its end") {
  Cabin cabin({.engine = false});
  cabin.run(0.13);
  cabin.car.over_revved = true;
  CHECK(strongest_line(left(cabin.run(0.1))) == doctest::Approx(kOverRevTone).epsilon(0.01));
  cabin.run(0.15);
  std::vector<double> x = left(cabin.run(2.0));
  CHECK(line_prominence(x, kOverRevRate) > 3.0);
  cabin.car.over_revved = false;
  CHECK(silent(cabin, VehicleState{}));
}

TEST_CASE("a stall with the ignition on is announced by one chime; a start or a turn of the key is not") {
  Cabin cabin({.engine = false});
  const auto chimes = [&](const VehicleState& car) {
    cabin.car = car;
    return strongest_line(left(cabin.run(0.2))) == doctest::Approx(kStallTones[0]).epsilon(0.02);
  };
  VehicleState stalled = dead(0.0);
  stalled.stalled = true;
  VehicleState off = dead(0.0);
  off.ignition = false;
  CHECK_FALSE(chimes(off));
  CHECK(silent(cabin, dead(0.0)));  // the ignition is on, but the engine was never running
  CHECK_FALSE(chimes(cranked(200.0)));
  CHECK_FALSE(chimes(running(800.0, 0.1)));
  CHECK(chimes(stalled));
  cabin.run(1.2);
  CHECK(silent(cabin, stalled));  // the chime is not repeated
  VehicleState cranks_again = cranked(200.0);
  cranks_again.stalled = true;
  CHECK_FALSE(chimes(cranks_again));
  CHECK(silent(cabin, stalled));
  CHECK_FALSE(chimes(running(800.0, 0.1)));
  CHECK_FALSE(chimes(off));
  CHECK(silent(cabin, dead(0.0)));
  Cabin late({.engine = false});
  late.car = stalled;
  CHECK(peak(doubles(late.run(0.3))) == 0.0);  // no chime, because the stall happened before this sound output began
}

TEST_CASE("dogs rattle |difference| * teeth / (2 pi) times per second, louder with the power") {
  Cabin cabin({.engine = false});
  for (const double difference : {10.0, 26.18, -59.0, 100.0}) {
    CAPTURE(difference);
    const double rate = std::abs(difference) * 36.0 / (2.0 * std::numbers::pi);
    CHECK(line_prominence(left_ear(cabin, grinding(difference, 50.0)), rate) > 3.0);
  }
  Cabin coarse({.engine = false, .dog_teeth = 24.0});
  const std::vector<double> x = left_ear(coarse, grinding(30.0, 50.0));
  CHECK(line_prominence(x, 30.0 * 24.0 / (2.0 * std::numbers::pi)) > 3.0);
  CHECK(line_prominence(x, 30.0 * 36.0 / (2.0 * std::numbers::pi)) < 2.0);
  const double soft = rms(left_ear(cabin, grinding(30.0, 0.0))), loud = rms(left_ear(cabin, grinding(30.0, 100.0)));
  CHECK(soft > 0.005);
  CHECK(loud / soft == doctest::Approx(0.5 / 0.32).epsilon(0.02));
  VehicleState apart = grinding(30.0, 100.0);
  apart.grinding = false;
  CHECK(silent(cabin, apart));
}

TEST_CASE("with help, a tick tells the clutch's bite point each time the pedal passes it; without, none does") {
  for (const double help : {0.0, 0.4, 1.0}) {
    CAPTURE(help);
    Cabin cabin({.engine = false});
    cabin.sound.set_bite_tick(help);
    cabin.car.clutch_bite = 0.75;
    const auto is_heard = [&](double pedal) {
      cabin.car.pedals.clutch = pedal;
      return peak(doubles(cabin.run(0.2))) > 0.0;
    };
    CHECK_FALSE(is_heard(0.5));
    CHECK(is_heard(1.0) == (help > 0.0));
    CHECK_FALSE(is_heard(0.8));
    CHECK(is_heard(0.7) == (help > 0.0));
    CHECK_FALSE(is_heard(0.0));
    cabin.car.pedals.clutch = 0.9;
    if (help > 0.0) CHECK(strongest_line(left(cabin.run(0.05))) == doctest::Approx(kBiteTone).epsilon(0.02));
  }
}
