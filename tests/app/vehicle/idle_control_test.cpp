// The idle control: it moves a car off without throttle, as real cars do, returns to idle exactly under a load, and its
// state is part of a recording.
#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include <doctest/doctest.h>

#include "app/lab/bench/driveline/closed_forms.h"
#include "app/lab/bench/driveline/driveline_rig.h"
#include "app/lab/bench/driveline/drives.h"
#include "app/vehicle/car_load.h"
#include "tests/app/vehicle/cars.h"

using namespace gearshift::lab;
using namespace gearshift::test;
using namespace gearshift::vehicle;
using doctest::Approx;

namespace {

// Drives to the end, and returns the driveline.
Driveline driven(const Drive& drive) {
  Driveline line(drive.car);
  line.place(drive.engine, drive.shaft, drive.road, true);
  for (int i = 0; i <= std::lround(1e3 * drive.duration); ++i) line.step(drive.input(0.001 * i), 0.001);
  return line;
}

}  // namespace

TEST_CASE("on a flat road, without throttle: first in 1.5 s moves the petrol car off, second in 3 s the diesel") {
  for (const auto& [name, gear, seconds] :
       {std::tuple("hatchback", 1, 1.5), std::tuple("diesel", 2, 3.0), std::tuple("diesel", 1, 1.5)}) {
    CAPTURE(name);
    const CarSpec car = shipped_car(name);
    Drive drive = pull_away(car, gear, seconds);
    drive.duration += 8.0;
    const Driveline line = driven(drive);
    CHECK(line.state().running);
    CHECK(line.state().clutch_locked);
    // It then idles along in this gear.
    CHECK(line.state().engine_speed == Approx(car.engine.idle).epsilon(0.02));
    CHECK(line.state().road_speed == Approx(car.engine.idle / shaft_per_road(car, gear)).epsilon(0.02));
  }
}

TEST_CASE("a dumped clutch stalls both cars, in first and second") {
  for (const char* name : {"hatchback", "diesel"}) {
    for (const int gear : {1, 2}) {
      for (const double seconds : {0.03, 0.1}) {
        CAPTURE(name);
        CAPTURE(gear);
        CAPTURE(seconds);
        const Driveline line = driven(pull_away(shipped_car(name), gear, seconds));
        CHECK(line.state().stalled);
        CHECK(line.state().engine_speed == 0.0);
      }
    }
  }
}

TEST_CASE("the pedal adds to the idle control, also while the engine is slow") {
  const CarSpec car = shipped_car("hatchback");
  EngineControl control(car.engine);
  for (const double speed : {0.6 * car.engine.idle, 0.95 * car.engine.idle}) {
    const double idling = control.load(speed, 0.0);
    CHECK(control.load(speed, 0.3) == Approx(idling + 0.3 * (1.0 - idling)));
    CHECK(control.load(speed, 1.0) == 1.0);
  }
  CHECK(control.load(2.0 * car.engine.idle, 0.3) == 0.3);
}

TEST_CASE("under a lasting load the engine returns to its idle speed, and never turns slower for it later") {
  const CarSpec car = shipped_car("hatchback");
  Driveline line(car);
  line.place(car.engine.idle, 0.0, 0.0, true);
  DrivelineInput held = pedals(1, 0.0, 0.6);  // a quarter of the way: 15 N m, which the brake holds
  held.pedals.brake = 1.0;
  double lowest = 1e9;
  for (int i = 0; i < 10000; ++i) {
    line.step(held, 0.001);
    lowest = std::min(lowest, line.state().engine_speed);
  }
  CHECK(lowest < 0.97 * car.engine.idle);
  CHECK(line.state().clutch_torque == Approx(15.0));
  CHECK(line.state().engine_speed == Approx(car.engine.idle + car.engine.idle_lift).epsilon(1e-3));
  // The integral part does not remember a long time above idle.
  drive(line, pedals(0, 0.5, 1.0), 3.0);
  lowest = 1e9;
  for (int i = 0; i < 5000; ++i) {
    line.step(pedals(0, 0.0, 1.0), 0.001);
    lowest = std::min(lowest, line.state().engine_speed);
  }
  CHECK(lowest > 0.995 * car.engine.idle);
  CHECK(line.state().engine_speed == Approx(car.engine.idle).epsilon(1e-6));
}

TEST_CASE("every closed form of the bench is met: to 0.01 %, balances to rounding") {
  std::vector<BenchRow> rows;
  add_closed_forms(rows);
  CHECK(rows.size() >= 7);
  for (const BenchRow& row : rows) {
    CAPTURE(row.name);
    REQUIRE(row.goal);
    CHECK(row.value < *row.goal);
  }
}

TEST_CASE("a car that continues from a state drives on as if it had not been interrupted") {
  const CarSpec car = shipped_car("diesel");
  const Drive drive = pull_away(car, 2, 3.0);
  Driveline whole(car);
  whole.place(drive.engine, drive.shaft, drive.road, true);
  for (int i = 0; i <= 1500; ++i) whole.step(drive.input(0.001 * i), 0.001);
  const CarStart from = start_from(whole.state());
  CHECK(from.engine.integral > 0.05);
  CHECK(from.engine.lift > 0.1 * car.engine.idle_lift);
  Driveline rest(car);
  rest.place(*from.engine_speed, *from.shaft_speed, from.road_speed, from.running, from.stalled, from.engine,
             from.clutch_temperature);
  rest.step(drive.input(1.5), 0.0);
  for (int i = 1501; i <= 3000; ++i) {
    whole.step(drive.input(0.001 * i), 0.001);
    rest.step(drive.input(0.001 * i), 0.001);
  }
  CHECK(rest.state().engine_speed == Approx(whole.state().engine_speed).epsilon(1e-9));
}
