// Hard cases for the driveline: standing, holding, stalling, chattering, late steps, and non-finite inputs.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include <doctest/doctest.h>

#include "app/lab/bench/driveline/driveline_rig.h"
#include "app/lab/bench/driveline/drives.h"
#include "tests/app/vehicle/cars.h"

using namespace gearshift::haptics;
using namespace gearshift::lab;
using namespace gearshift::vehicle;
using doctest::Approx;
using gearshift::test::slip;

namespace {

constexpr double kGravity = 9.81;

Driveline at_rest(const CarSpec& car) {
  Driveline line(car);
  line.place(car.engine.idle, 0.0, 0.0, true);
  return line;
}

// The pedal position at which the clutch transmits `torque` [N m].
double pedal_for(const ClutchSpec& clutch, double torque) {
  return clutch.bite - (clutch.bite - clutch.closed) * std::sqrt(torque / clutch.capacity);
}

bool same_bits(const VehicleState& a, const VehicleState& b) {
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
  return bits(a.engine_speed) == bits(b.engine_speed) && bits(a.shaft_speed) == bits(b.shaft_speed) &&
         bits(a.road_speed) == bits(b.road_speed) && bits(a.distance) == bits(b.distance) &&
         bits(a.slip_energy) == bits(b.slip_energy) && bits(a.clutch_torque) == bits(b.clutch_torque);
}

}  // namespace

// On a slope of 20 %, a slipping clutch holds the car if its pull at the wheels (torque times shaft_per_road()) differs
// from the downhill force m g sin(slope) by no more than the rolling resistance.
TEST_CASE("on a hill a slipping clutch holds the car only while the rolling resistance covers the remaining force") {
  CarSpec car = hatchback();
  car.gearbox.drag = car.gearbox.drag_slope = 0.0;
  const double ratio = shaft_per_road(car, 1), slope = std::atan(0.2);
  const double pull = car.body.mass * kGravity * std::sin(slope), roll = car.body.resistance;
  struct Case {
    double torque;
    int goes;
  };
  const Case cases[] = {{(pull - roll) / ratio * (1.0 - 1e-6), -1},
                        {(pull - roll) / ratio * (1.0 + 1e-6), 0},
                        {pull / ratio, 0},
                        {(pull + roll) / ratio * (1.0 - 1e-6), 0},
                        {(pull + roll) / ratio * (1.0 + 1e-6), 1}};
  for (const Case& c : cases) {
    CAPTURE(c.torque);
    Driveline line = at_rest(car);
    line.place(200.0, 0.0, 0.0, true);
    DrivelineInput in = pedals(1, 0.6, pedal_for(car.clutch, c.torque));
    in.slope = slope;
    drive(line, in, 3.0);
    const double v = line.state().road_speed;
    CHECK((v > 0.0) - (v < 0.0) == c.goes);
    CHECK((line.state().distance == 0.0) == (c.goes == 0));
  }
}

TEST_CASE("foot brake and handbrake hold the car on a hill for a minute with trembling feet, and nothing creeps") {
  const CarSpec car = hatchback();
  std::mt19937 random(7);
  for (const bool hand : {false, true}) {
    Driveline line = at_rest(car);
    bool still = true;
    for (int i = 0; i < 60000; ++i) {
      DrivelineInput in = pedals(1, 0.0, 1.0);
      (hand ? in.pedals.hand_brake : in.pedals.brake) =
          0.7 + 0.05 * std::uniform_real_distribution<double>(-1.0, 1.0)(random);
      in.slope = 0.2;
      line.step(in, 0.001);
      still = still && line.state().road_speed == 0.0 && line.state().shaft_speed == 0.0;
    }
    CHECK(still);
    CHECK(line.state().distance == 0.0);
    CHECK(line.fallbacks() == 0);
  }
}

TEST_CASE("a car released on a hill rolls back, and stops when braked") {
  Driveline line = at_rest(hatchback());
  DrivelineInput in = pedals(0, 0.0, 1.0);
  in.slope = 0.1;
  drive(line, in, 2.0);
  CHECK(line.state().road_speed < -1.0);
  in.pedals.brake = 0.5;
  drive(line, in, 2.0);
  CHECK(line.state().road_speed == 0.0);
}

// In first gear, a stopped engine holds the car on a slope either way with its friction, but no more.
TEST_CASE("a stopped engine in gear holds the car on a hill, either way") {
  const CarSpec car = hatchback();
  DrivelineInput in = pedals(1, 0.0, 0.0);
  in.ignition = false;
  for (const double slope : {0.03, -0.03, 0.2, -0.2}) {
    Driveline line(car);
    line.place(0.0, 0.0, 0.0, false);
    in.slope = slope;
    drive(line, in, 5.0);
    const bool holds = std::abs(slope) < 0.1;
    CHECK((line.state().road_speed == 0.0) == holds);
    CHECK((line.state().engine_speed == 0.0) == holds);
    if (!holds) CHECK(line.state().engine_speed * slope < 0.0);
  }
}

TEST_CASE("a dumped clutch stalls the engine; the starter restarts it, also repeatedly") {
  Driveline line = at_rest(hatchback());
  drive(line, pedals(1, 0.0, 1.0), 0.2);
  drive(line, pedals(1, 0.0, 0.0), 3.0);
  CHECK(line.state().stalled);
  CHECK(line.state().engine_speed == 0.0);
  CHECK(line.state().road_speed == 0.0);
  for (int i = 0; i < 2; ++i) {
    drive(line, pedals(1, 1.0, 1.0), 1.0);
    CHECK_FALSE(line.state().running);
    DrivelineInput in = pedals(1, 0.0, 1.0);
    in.starter = true;
    drive(line, in, 1.0);
    CHECK(line.state().running);
    CHECK_FALSE(line.state().stalled);
    drive(line, pedals(1, 0.0, 1.0), 5.0);
    CHECK(line.state().engine_speed == Approx(84.0).epsilon(1e-3));
    in.ignition = false;
    drive(line, in, 3.0);
    CHECK_FALSE(line.state().running);
    CHECK_FALSE(line.state().stalled);  // switching the engine off is not a stall
  }
}

TEST_CASE("only an engine that ran by itself can stall, not one that never started or was switched off") {
  const CarSpec car = hatchback();
  Driveline line(car);
  line.place(0.0, 0.0, 0.0, false);
  const DrivelineInput on = pedals(0, 0.0, 1.0);
  DrivelineInput cranks = on, off = on;
  cranks.starter = true;
  off.ignition = false;
  // Releases the starter as soon as the engine fires. The engine cannot run by itself yet, so it dies again.
  const auto start_badly = [&] {
    for (int i = 0; i < 5000 && !line.state().running; ++i) line.step(cranks, 0.001);
    REQUIRE(line.state().engine_speed < car.engine.stall);
    drive(line, on, 2.0);
    REQUIRE_FALSE(line.state().running);
  };
  CHECK_FALSE(line.state().stalled);
  drive(line, on, 1.0);
  CHECK_FALSE(line.state().stalled);
  start_badly();
  CHECK_FALSE(line.state().stalled);
  drive(line, cranks, 2.0);
  drive(line, on, 1.0);
  CHECK(line.state().running);
  CHECK_FALSE(line.state().stalled);
  drive(line, pedals(1, 0.0, 0.0), 2.0);
  CHECK(line.state().stalled);
  start_badly();
  CHECK(line.state().stalled);
  drive(line, off, 0.01);
  CHECK_FALSE(line.state().stalled);
  drive(line, on, 1.0);
  CHECK_FALSE(line.state().stalled);
  drive(line, cranks, 2.0);
  drive(line, off, 0.01);  // the engine was running, and is switched off
  CHECK_FALSE(line.state().running);
  drive(line, on, 3.0);
  CHECK_FALSE(line.state().stalled);
}

TEST_CASE("with the clutch up the starter drives the car in gear while the engine does not fire") {
  CarSpec car = hatchback();
  car.engine.starter_torque = 10.0;  // [N m] exceeds the engine's friction of 8, but cannot move the car
  Driveline line(car);
  line.place(0.0, 0.0, 0.0, false);
  DrivelineInput in = pedals(1, 0.0, 0.0);
  in.starter = true;
  drive(line, in, 3.0);
  CHECK(line.state().road_speed == 0.0);
  car.engine.starter_torque = 60.0;
  Driveline strong(car);
  strong.place(0.0, 0.0, 0.0, false);
  drive(strong, in, 0.2);
  CHECK(strong.state().road_speed > 0.0);
  CHECK(strong.state().engine_speed == strong.state().shaft_speed);
}

TEST_CASE("rolling starts a stalled engine, but only with the ignition on") {
  const CarSpec car = hatchback();
  for (const bool ignition : {true, false}) {
    Driveline line(car);
    line.place(0.0, 0.0, 10.0, false);
    DrivelineInput in = pedals(3, 0.3, 0.0);
    in.ignition = ignition;
    drive(line, in, 1.0);
    CHECK(line.state().engine_speed > car.engine.stall);
    CHECK(line.state().running == ignition);
  }
}

TEST_CASE("in fifth at 5 m/s the engine lugs and pulls; at 2.5 m/s it stalls") {
  const CarSpec car = hatchback();
  for (const double speed : {5.0, 2.5}) {
    Driveline line(car);
    line.place(84.0, 0.0, speed, true);
    for (int i = 0; i < 500; ++i) line.step(pedals(5, 0.1, 1.0 - i / 500.0), 0.001);
    drive(line, pedals(5, 1.0, 0.0), 1.0);
    CHECK(line.state().running == (speed == 5.0));
    if (speed == 5.0) CHECK(line.state().engine_speed < car.engine.lug_below);
  }
}

TEST_CASE("the limiter cuts and resumes within its band without the impulse fallback") {
  const CarSpec car = hatchback();
  Driveline line = at_rest(car);
  drive(line, pedals(0, 1.0, 1.0), 3.0);
  double lowest = 1e9, highest = 0.0;
  int cuts = 0;
  bool was = true;
  for (int i = 0; i < 2000; ++i) {
    line.step(pedals(0, 1.0, 1.0), 0.001);
    lowest = std::min(lowest, line.state().engine_speed);
    highest = std::max(highest, line.state().engine_speed);
    const bool fires = line.state().engine_load > 0.0;
    cuts += was && !fires;
    was = fires;
  }
  CHECK(highest < car.engine.limiter + 1e-6);
  CHECK(lowest > car.engine.limiter - car.engine.limiter_band - 1e-6);
  CHECK(highest - lowest > 0.8 * car.engine.limiter_band);
  CHECK(cuts > 10);
  CHECK(cuts < 100);
  CHECK(line.fallbacks() == 0);
}

TEST_CASE(
    "a limiter without a band would toggle forever: the impulse fallback finishes the step, and the speed is held") {
  CarSpec car = hatchback();
  car.engine.limiter_band = 0.0;
  Driveline line = at_rest(car);
  drive(line, pedals(0, 1.0, 1.0), 3.0);
  CHECK(line.fallbacks() > 100);
  CHECK(line.state().engine_speed == Approx(car.engine.limiter).epsilon(0.003));
  const EnergyLedger& e = line.energy();
  const double begin = 0.5 * car.engine.inertia * car.engine.idle * car.engine.idle;
  CHECK(begin + e.engine - e.friction == Approx(line.kinetic_energy()).epsilon(1e-9));
}

// One long step replaces the missing steps. The driveline assumes that the pedals moved linearly during that step, as
// they do in this test.
TEST_CASE("a late step of 33, 100 or 500 ms gives the same result as steps of 1 ms") {
  const auto foot = [](double t) { return pedals(1, ramp(t, 0.0, 0.5, 0.0, 0.25), ramp(t, 0.25, 1.75, 1.0, 0.0)); };
  for (const int late : {33, 100, 500}) {
    CAPTURE(late);
    Driveline line = at_rest(hatchback()), other = line;
    line.step(foot(0.0), 0.0);
    other.step(foot(0.0), 0.0);
    for (int i = 1; i <= 2500; ++i) {
      line.step(foot(0.001 * i), 0.001);
      if (i > 800 && i < 800 + late) continue;
      other.step(foot(0.001 * i), i == 800 + late ? 0.001 * late : 0.001);
    }
    CHECK(other.state().engine_speed == Approx(line.state().engine_speed).epsilon(1e-5));
    CHECK(other.state().distance == Approx(line.state().distance).epsilon(1e-5));
    CHECK(other.energy().clutch == Approx(line.energy().clutch).epsilon(1e-5));
  }
}

TEST_CASE("half a second is the longest step; zero, negative and NaN steps move nothing") {
  Driveline line(hatchback());
  line.place(84.0, 0.0, 10.0, true);
  for (const double seconds : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    line.step(pedals(0, 0.0, 1.0), seconds);
    CHECK(line.state().distance == 0.0);
    CHECK(line.state().road_speed == 10.0);
  }
  line.step(pedals(0, 0.0, 1.0), std::numeric_limits<double>::infinity());
  CHECK(line.state().distance == Approx(5.0).epsilon(0.01));
}

TEST_CASE("a step of zero length applies the pedals and updates the outputs") {
  const CarSpec car = hatchback();
  Driveline line(car);
  line.place(300.0, 0.0, 0.0, true);
  line.step(pedals(1, 0.0, 0.0), 0.0);
  CHECK(line.state().clutch_torque == car.clutch.capacity);
  CHECK(line.state().acceleration > 1.0);
  CHECK(line.state().road_speed == 0.0);
}

// In the only step (1 ms), the car stops, and with it the gearbox shaft. So the shaft is first faster and then slower
// than the engine.
TEST_CASE("with the clutch down the car's stopping does not affect the engine") {
  const CarSpec car = hatchback();
  Driveline line(car);
  line.place(0.15, 0.2, 0.2 / shaft_per_road(car, 1), false);
  DrivelineInput in = pedals(1, 0.0, 1.0);
  in.pedals.brake = 1.0;
  in.ignition = false;
  line.step(in, 0.001);
  CHECK(line.state().road_speed == 0.0);
  CHECK(line.state().engine_speed == Approx(0.15 - 0.001 * car.engine.friction / car.engine.inertia).epsilon(1e-4));
}

TEST_CASE("a trembling clutch pedal locks once and does not chatter") {
  Driveline line = at_rest(hatchback());
  std::mt19937 random(3);
  int changes = 0;
  bool was = false;
  for (int i = 0; i < 4000; ++i) {
    const double noise = std::uniform_real_distribution<double>(-0.01, 0.01)(random);
    line.step(pedals(1, 0.3, ramp(0.001 * i, 0.2, 1.7, 1.0, 0.0) + noise), 0.001);
    changes += line.state().clutch_locked != was;
    was = line.state().clutch_locked;
  }
  CHECK(was);
  CHECK(changes == 1);
  CHECK(slip(line) == 0.0);
  CHECK(line.fallbacks() == 0);
}

TEST_CASE("a locked clutch stays exactly locked under drive and overrun, for any throttle") {
  const CarSpec car = hatchback();
  Driveline line(car);
  line.place(300.0, 300.0, 300.0 / shaft_per_road(car, 3), true);
  std::mt19937 random(5);
  line.step(pedals(3, 0.0, 0.0), 0.0);
  drive(line, pedals(3, 0.0, 0.0), 0.05);
  bool locked = true;
  for (int i = 0; i < 10000; ++i) {
    line.step(pedals(3, static_cast<double>(random() % 2), 0.0), 0.001);
    locked = locked && slip(line) == 0.0 && line.state().clutch_locked;
  }
  CHECK(locked);
}

// Until the shaft stops, its speed w follows J w' = -(d + s w), with the inertia J, the drag d and the drag's slope s.
TEST_CASE(
    "in neutral the shaft turns with the engine while the clutch is up, and its drag stops it with the clutch down") {
  const CarSpec car = hatchback();
  Driveline line = at_rest(car);
  drive(line, pedals(0, 0.0, 0.0), 1.0);
  CHECK(slip(line) == 0.0);
  CHECK(line.state().clutch_locked);
  const double begin = line.state().shaft_speed, d = car.gearbox.drag, s = car.gearbox.drag_slope;
  line.step(pedals(0, 0.0, 1.0), 1e-9);
  const double stops = car.clutch.disc_inertia / s * std::log1p(s * begin / d);
  drive(line, pedals(0, 0.0, 1.0), std::floor(stops * 0.5 * 1e3) * 1e-3);
  const double t = std::floor(stops * 0.5 * 1e3) * 1e-3;
  CHECK(line.state().shaft_speed ==
        Approx((begin + d / s) * std::exp(-s * t / car.clutch.disc_inertia) - d / s).epsilon(1e-6));
  drive(line, pedals(0, 0.0, 1.0), stops);
  CHECK(line.state().shaft_speed == 0.0);
}

TEST_CASE("zero capacity transmits nothing; infinite capacity locks at once, conserving momentum") {
  Driveline loose(bare_car(0.15, 0.569, 0.0));
  loose.place(300.0, 30.0, 3.0, false);
  DrivelineInput in = pedals(1, 0.0, 0.0);
  in.ignition = false;
  drive(loose, in, 1.0);
  CHECK(loose.state().engine_speed == 300.0);
  CHECK(loose.state().road_speed == 3.0);
  CHECK_FALSE(loose.state().clutch_locked);
  for (const double capacity : {1e9, 1e300, std::numeric_limits<double>::infinity()}) {
    Driveline tight(bare_car(0.15, 0.569, capacity));
    tight.place(300.0, 30.0, 3.0, false);
    tight.step(in, 0.001);
    CHECK(tight.state().clutch_locked);
    CHECK(tight.state().engine_speed == Approx(86.3282).epsilon(1e-5));
    CHECK(tight.energy().clutch == Approx(4326.85).epsilon(1e-5));
  }
}

TEST_CASE("non-finite input counts as zero and has no later effect") {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();
  for (const double bad : {kNan, kInf, -kInf}) {
    Driveline line(hatchback()), other(hatchback());
    line.place(200.0, 0.0, 5.0, true);
    other.place(200.0, 0.0, 5.0, true);
    DrivelineInput in;
    in.pedals.throttle = in.pedals.brake = in.pedals.clutch = in.pedals.hand_brake = in.slope = in.cone_torque = bad;
    in.cone_gear = 2;
    for (int i = 0; i < 100; ++i) {
      line.step(in, 0.001);
      DrivelineInput none;
      none.cone_gear = 2;
      other.step(none, 0.001);
    }
    CHECK(same_bits(line.state(), other.state()));
  }
  Driveline line(hatchback());
  line.place(kNan, kInf, -kInf, true);
  line.step({}, 0.001);
  CHECK(std::isfinite(line.kinetic_energy()));
}

TEST_CASE("a gear that the gearbox lacks is neutral") {
  for (const int gear : {6, 9, 10, -2, 1000000}) {
    Driveline line(hatchback());
    line.place(84.0, 0.0, 10.0, true);
    drive(line, pedals(gear, 0.0, 1.0), 0.1);
    CHECK(line.state().gear == kNeutralGear);
    CHECK(line.state().shaft_speed == 0.0);
  }
}

TEST_CASE("reverse drives backwards, and the wheel torque has the right sign") {
  Driveline line = at_rest(hatchback());
  for (int i = 0; i < 3000; ++i) line.step(pedals(kReverseGear, 0.3, ramp(0.001 * i, 0.2, 1.7, 1.0, 0.0)), 0.001);
  CHECK(line.state().road_speed < -1.0);
  CHECK(line.state().drive_torque < 0.0);
  CHECK(line.state().acceleration < 0.0);
  CHECK(line.state().clutch_torque > 0.0);
  CHECK(line.state().shaft_speed > 0.0);
  CHECK(line.state().distance < 0.0);
}

TEST_CASE("repeated drives are bit-identical") {
  for (const Drive& d : all_drives()) {
    Driveline one(d.car), other(d.car);
    one.place(d.engine, d.shaft, d.road, true);
    other.place(d.engine, d.shaft, d.road, true);
    bool same = true;
    for (int i = 0; i <= std::lround(1e3 * d.duration); ++i) {
      one.step(d.input(0.001 * i), 0.001);
      other.step(d.input(0.001 * i), 0.001);
      same = same && same_bits(one.state(), other.state());
    }
    CHECK(same);
  }
}

TEST_CASE("the driveline does not change the lever's part of the state") {
  Driveline line = at_rest(hatchback());
  drive(line, pedals(1, 0.5, 0.0), 1.0);
  const VehicleState untouched;
  CHECK(line.state().sync == untouched.sync);
  CHECK(line.state().grinding == untouched.grinding);
  CHECK(line.state().force_scale == untouched.force_scale);
}
