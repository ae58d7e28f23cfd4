// Tests of the states that the driveline reports to sound and instruments: fuel cut, clutch points, starting, stalling.
#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "app/lab/bench/driveline/driveline_rig.h"
#include "tests/app/vehicle/cars.h"

using namespace gearshift::haptics;
using namespace gearshift::lab;
using namespace gearshift::test;
using namespace gearshift::vehicle;

TEST_CASE(
    "the fuel is cut from the limiter down to its band, 6500 to 6400 rpm, is reported as cut, and never cut below") {
  Driveline line(shipped_car("hatchback"));
  int cuts = 0;
  bool before = false;
  for (int i = 0; i < 4000; ++i) {
    line.step(pedals(kNeutralGear, 1.0, 1.0), 1e-3);
    const VehicleState& car = line.state();
    const double rpm = car.engine_speed / kRpm;
    if (rpm < 6399.9) REQUIRE_FALSE(car.fuel_cut);
    if (rpm > 6500.1) REQUIRE(car.fuel_cut);
    if (car.fuel_cut) REQUIRE(car.engine_load == 0.0);
    cuts += car.fuel_cut && !before ? 1 : 0;
    before = car.fuel_cut;
  }
  MESSAGE("cut " << cuts << " times in 4 s");
  CHECK(cuts > 10);
}

TEST_CASE("the clutch begins to transmit at the reported bite point, and transmits all at the reported closed point") {
  for (const char* name : {"hatchback", "diesel"}) {
    CAPTURE(name);
    const CarSpec car = shipped_car(name);
    Driveline line(car);
    const VehicleState initial = line.state();  // the clutch points are reported before the first step
    CHECK(initial.clutch_bite > initial.clutch_closed);
    const auto carries = [&](double pedal) {
      line.step(pedals(kNeutralGear, 0.0, pedal), 1e-3);
      return line.state().clutch_capacity;
    };
    CHECK(carries(initial.clutch_bite + 1e-6) == 0.0);
    CHECK(carries(initial.clutch_bite - 1e-6) > 0.0);
    CHECK(carries(initial.clutch_closed + 1e-6) < car.clutch.capacity);
    CHECK(carries(initial.clutch_closed - 1e-6) == car.clutch.capacity);
    CHECK(line.state().clutch_bite == initial.clutch_bite);
  }
}

TEST_CASE("cranking is reported while the starter turns the engine, and not once it runs, even if the key is held") {
  const CarSpec car = shipped_car("hatchback");
  Driveline line(car);
  line.place(0.0, 0.0, 0.0, false);
  DrivelineInput in = pedals(kNeutralGear, 0.0, 1.0);
  line.step(in, 1e-3);
  CHECK_FALSE(line.state().cranking);
  in.starter = true;
  line.step(in, 1e-3);
  CHECK(line.state().cranking);
  drive(line, in, 3.0);
  CHECK(line.state().running);
  CHECK_FALSE(line.state().cranking);
  in.starter = in.ignition = false;
  drive(line, in, 5.0);
  in.starter = true;
  line.step(in, 1e-3);
  CHECK_FALSE(line.state().cranking);  // the ignition is off, so the starter does not crank
}

TEST_CASE("starting takes two engine turns and at least half a second; released earlier, the engine stays off") {
  for (const char* name : {"hatchback", "diesel"}) {
    CAPTURE(name);
    const CarSpec car = shipped_car(name);
    Driveline line(car);
    line.place(0.0, 0.0, 0.0, false);
    DrivelineInput in = pedals(kNeutralGear, 0.0, 1.0);
    in.starter = true;
    double turned = 0.0, time = 0.0;
    while (!line.state().running && time < 5.0) {
      const double before = line.state().engine_speed;
      line.step(in, 1e-3);
      turned += 0.5e-3 * (before + line.state().engine_speed);
      time += 1e-3;
    }
    CHECK(turned == doctest::Approx(12.566).epsilon(0.004));
    CHECK(time > 0.5);
    CHECK(time < 1.2);
    Driveline early(car);
    early.place(0.0, 0.0, 0.0, false);
    drive(early, in, time - 0.01);
    in.starter = false;
    drive(early, in, 3.0);
    CHECK_FALSE(early.state().running);
    CHECK(early.state().engine_speed == 0.0);
  }
}

TEST_CASE("reverse at 5 m/s forwards stops the engine and turns it backwards, until the car stops") {
  const CarSpec car = shipped_car("hatchback");
  Driveline line(car);
  line.place(car.engine.idle, shaft_per_road(car, kReverseGear) * 5.0, 5.0, true);
  double lowest = 0.0;
  for (int i = 0; i < 8000; ++i) {
    line.step(pedals(kReverseGear, 0.4, std::max(0.0, 1.0 - i / 1500.0)), 1e-3);
    lowest = std::min(lowest, line.state().engine_speed);
  }
  CHECK(lowest < -50.0);
  CHECK_FALSE(line.state().running);
  CHECK(line.state().engine_speed == 0.0);
  CHECK_FALSE(std::signbit(line.state().engine_speed));
  CHECK(line.state().road_speed == 0.0);
}
