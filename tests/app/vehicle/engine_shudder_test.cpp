// An engine that lugs or dies shakes the car, and the lever with the car.
#include "app/vehicle/engine_shudder.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "app/lab/bench/driveline/driveline_rig.h"
#include "tests/app/vehicle/car_run.h"

using namespace gearshift::haptics;
using namespace gearshift::lab;
using namespace gearshift::test;
using namespace gearshift::vehicle;

namespace {

// [1] The shudder of the hatchback's engine. The engine idles at 800 rpm and stalls 450 rpm lower, at 350 rpm. It
// shudders once it has lost more than a quarter (kSmoothDip) of these 450 rpm, so below 687.5 rpm. At idle its friction
// is 14.286 N m.
double shudder_at(double rpm, double clutch_torque, bool running = true) {
  static const EngineSpec engine = shipped_car("hatchback").engine;
  VehicleState car;
  car.engine_speed = rpm * kRpm;
  car.clutch_torque = clutch_torque;
  car.running = running;
  return engine_shudder(engine, car);
}

struct ShudderOutcome {
  double max = 0.0, last = 0.0, highest_step = 0.0;
  bool stalled = false;
};

// Moves off in first gear from idle. `feet` returns the clutch and throttle positions at a time [s]; `brake` is
// constant.
template <typename Pedals>
ShudderOutcome drive_off(const Pedals& feet, double seconds, double brake) {
  Driveline line(shipped_car("hatchback"));
  ShudderOutcome out;
  for (int i = 0; i < std::lround(seconds / 1e-4); ++i) {
    DrivelineInput in = feet(1e-4 * i);
    in.meshed = 1;
    in.pedals.brake = brake;
    line.step(in, 1e-4);
    out.highest_step = std::max(out.highest_step, std::abs(line.state().shudder - out.last));
    out.last = line.state().shudder;
    out.max = std::max(out.max, out.last);
    out.stalled = out.stalled || line.state().stalled;
  }
  return out;
}

DrivelineInput let_up(double time, double begin, double length, double throttle) {
  return pedals(1, throttle, 1.0 - std::clamp((time - begin) / length, 0.0, 1.0));
}

CarStart in_first() {
  CarStart start;
  start.gear = 1;
  return start;
}

DriverControls dump(double time) {
  DriverControls feet = time < 0.3 ? clutch_down() : clutch_up();
  feet.pedals.brake = 1.0;
  return feet;
}

}  // namespace

TEST_CASE("computed by hand: no shudder from 687.5 rpm up, half at 518.75, all at the stall speed, none at rest") {
  for (const double rpm : {6000.0, 800.0, 687.5}) CHECK(shudder_at(rpm, 50.0) == 0.0);
  CHECK(shudder_at(518.75, 50.0) == doctest::Approx(0.5));
  CHECK(shudder_at(350.0, 50.0) == doctest::Approx(1.0));
  CHECK(shudder_at(350.0, 7.143) == doctest::Approx(0.5).epsilon(1e-3));  // 7.143 N m is half of the friction at idle
  CHECK(shudder_at(500.0, 0.0) == 0.0);                                   // the clutch is down
  CHECK(shudder_at(500.0, -50.0) == 0.0);                                 // the car drives the engine
  CHECK(shudder_at(350.0, 0.0, false) == doctest::Approx(1.0));
  CHECK(shudder_at(175.0, 0.0, false) == doctest::Approx(0.5));
  CHECK(shudder_at(0.0, 0.0, false) == 0.0);
}

TEST_CASE("cranking and a switched-off ignition cause no shudder") {
  const EngineSpec engine = shipped_car("hatchback").engine;
  VehicleState car;
  car.engine_speed = 250.0 * kRpm;
  car.running = false;
  REQUIRE(engine_shudder(engine, car) > 0.5);
  car.cranking = true;
  CHECK(engine_shudder(engine, car) == 0.0);
  car.cranking = false;
  car.ignition = false;
  CHECK(engine_shudder(engine, car) == 0.0);
}

TEST_CASE(
    "a practised launch does not shudder; a dumped clutch does, fully and continuously, until the engine is at rest") {
  const ShudderOutcome launch = drive_off([](double t) { return let_up(t, 0.5, 1.5, 0.4); }, 4.0, 0.0);
  CHECK_FALSE(launch.stalled);
  CHECK(launch.max == 0.0);
  const ShudderOutcome dumped = drive_off([](double t) { return let_up(t, 0.5, 0.03, 0.0); }, 3.0, 1.0);
  CHECK(dumped.stalled);
  CHECK(dumped.max > 0.95);
  CHECK(dumped.highest_step < 0.05);
  CHECK(dumped.last == 0.0);
  const ShudderOutcome slow = drive_off([](double t) { return let_up(t, 0.5, 3.0, 0.0); }, 6.0, 1.0);
  CHECK(slow.stalled);  // against the brake the engine labours until it dies
  CHECK(slow.max > 0.95);
}

TEST_CASE("the lever vibrates at the firing frequency, 20 Hz at 600 rpm, with zero mean and within its amplitude") {
  LeverVibration shake(3.0);
  std::vector<double> force;
  for (int i = 0; i < 1000; ++i) force.push_back(shake.step(0.5, 600.0 * kRpm, 1e-3));
  int crossings = 0;
  double mean = 0.0, max = 0.0;
  for (std::size_t i = 0; i < force.size(); ++i) {
    crossings += i > 0 && force[i - 1] < 0.0 && force[i] >= 0.0 ? 1 : 0;
    mean += force[i] / 1000.0;
    max = std::max(max, std::abs(force[i]));
  }
  CHECK(force.front() == 0.0);
  CHECK(crossings >= 19);
  CHECK(crossings <= 20);
  CHECK(std::abs(mean) < 1e-3);
  CHECK(max <= 1.5);
  CHECK(max > 1.49);
  CHECK(shake.step(0.0, 600.0 * kRpm, 1e-3) == 0.0);
  CHECK(shake.step(1.0, 600.0 * kRpm, 1e-3) == 0.0);  // after a pause, the sine starts from zero again
}

TEST_CASE("without shudder a drive is bit-identical to one with a shudder force of 0: shifts, throttle, grinding") {
  std::vector<double> forces[2];
  for (const int shaken : {0, 1}) {
    CarSpec car = shipped_car("hatchback");
    car.synchro.friction = 0.06;  // a worn ring, so that the dogs grind
    car.engine.shudder = shaken == 0 ? 0.0 : 10.0;
    ScriptedHand hand = shifting_hand(gate_of(car), 2, {3, 4, 3, kNeutralGear, 2});
    CarRun run(car, rolling_in(car, 2, 250.0), hand,
               [](double time) { return std::fmod(time, 1.1) < 0.9 ? clutch_down() : clutch_up(0.4); });
    while (run.time() < hand.duration()) {
      const HapticSnapshot& lever = run.step();
      forces[shaken].insert(forces[shaken].end(), {lever.load_force.y, lever.lever.y, run.state().engine_speed});
      REQUIRE(run.state().shudder == 0.0);
    }
  }
  CHECK(forces[0] == forces[1]);
}

TEST_CASE("a stall vibrates the lever within the scaled amplitude, and leaves it in its gear and at rest") {
  for (const double rate : {1000.0, 4000.0}) {
    const CarSpec car = shipped_car("hatchback");
    const Gate gate = gate_of(car);
    IdleHand idle_hand;
    SimulatedRunConfig config = gripped(gate, 1);
    config.haptics.rate = rate;
    config.lever.hand = kBareHand;
    CarLoad load(car, gate, kPaperForce, in_first());
    SimulatedRun run(config, idle_hand, &load);
    const double max_force = car.engine.shudder * load.state().force_scale;
    double shaken = 0.0, moved = 0.0;
    glm::dvec2 rest{0.0};
    while (run.time() < 3.0) {
      run.inputs().controls.write(dump(run.time()));
      const HapticSnapshot& lever = run.step();
      if (run.time() < 0.29) rest = lever.lever;
      REQUIRE(std::abs(lever.load_force.y) <= max_force);
      shaken = std::max(shaken, std::abs(lever.load_force.y));
      if (run.time() > 0.3) moved = std::max(moved, std::abs(lever.lever.y - rest.y));
      REQUIRE((run.time() < 0.1 || lever.gear == 1));
      if (run.time() > 2.0) REQUIRE(lever.load_force == glm::dvec2(0.0));
      if (run.time() > 2.5) REQUIRE(std::abs(lever.lever.y - rest.y) < 2e-4);
    }
    MESSAGE("at " << rate << " Hz: " << shaken << " N of " << max_force << ", the lever moved " << 1e3 * moved
                  << " mm");
    CHECK(shaken > 0.2 * max_force);
    CHECK(moved < 0.003);
  }
}
