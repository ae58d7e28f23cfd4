// The clutch's temperature: what a launch, a held hill and a rest do to it, what is reported, and what a hot clutch
// transmits. The closed forms are rows of the bench, which idle_control_test.cpp checks.
#include <cmath>

#include <doctest/doctest.h>

#include "app/lab/bench/driveline/driveline_rig.h"
#include "tests/app/vehicle/cars.h"

using namespace gearshift::lab;
using namespace gearshift::test;
using namespace gearshift::vehicle;
using doctest::Approx;

TEST_CASE("a hot clutch loses capacity in proportion, from its fading point to nothing") {
  const double expected[][2] = {{40.0, 1.0}, {300.0, 1.0}, {350.0, 0.75}, {400.0, 0.5}, {500.0, 0.0}, {600.0, 0.0}};
  for (const auto& [temperature, fraction] : expected) CHECK(clutch_fade(temperature) == Approx(fraction));
}

TEST_CASE("one launch warms the clutch by its heat over its capacity; held on a hill it smells, then slips") {
  const CarSpec car = shipped_car("hatchback");
  Driveline line(car);
  line.place(car.engine.idle, 0.0, 0.0, true);
  for (int i = 0; i < 1500; ++i) line.step(pedals(1, 0.3, 1.0 - i / 1500.0), 0.001);
  drive(line, pedals(1, 0.3, 0.0), 1.0);
  const double rise = line.state().clutch_temperature - kAirTemperature;
  CHECK(rise == Approx(line.state().slip_energy / car.clutch.heat_capacity).epsilon(0.01));
  CHECK(rise > 0.5);
  CHECK_FALSE(line.state().clutch_smells);
  // On 15 %, full throttle against the brake: the engine is held near the speed where the clutch takes all its torque.
  DrivelineInput abused = pedals(1, 1.0, 0.42);
  abused.pedals.brake = 1.0;
  double smelt = 0.0, faded = 0.0;
  for (int i = 0; i < 200000 && faded == 0.0; ++i) {
    line.step(abused, 0.001);
    if (line.state().clutch_smells && smelt == 0.0) smelt = 0.001 * i;
    if (line.state().clutch_fades) faded = 0.001 * i;
  }
  CHECK(smelt > 3.0);  // seconds of gross abuse
  CHECK(faded > smelt);
  const double capacity = line.state().clutch_capacity;
  drive(line, abused, 5.0);
  CHECK(line.state().clutch_capacity < capacity);
  drive(line, pedals(0, 0.0, 1.0), 1200.0, 0.01);
  CHECK(line.state().clutch_temperature < 80.0);
  CHECK_FALSE(line.state().clutch_smells);
}
