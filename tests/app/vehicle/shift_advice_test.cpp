// The shift light of the hatchback at various road speeds.
#include "app/vehicle/shift_advice.h"

#include <cmath>

#include <doctest/doctest.h>

#include "app/lab/bench/driveline/driveline_rig.h"
#include "tests/app/vehicle/cars.h"

using namespace gearshift::haptics;
using namespace gearshift::lab;
using namespace gearshift::test;
using namespace gearshift::vehicle;

namespace {

// [km/h] Speed per 1000 rpm in each gear, computed by hand: 3.6 * 104.72 rad/s * 0.3032 m / (4.08 * gear ratio).
constexpr double kKmhPerKrpm[] = {8.120, 14.441, 21.718, 28.882, 36.862};

VehicleState in_gear(int gear, double kmh, double throttle) {
  VehicleState car;
  car.gear = gear;
  car.road_speed = kmh / 3.6;
  car.engine_speed = 1000.0 * kmh / kKmhPerKrpm[gear - 1] * kRpm;
  car.pedals.throttle = car.engine_load = throttle;
  car.clutch_locked = true;
  return car;
}

int advice(const VehicleState& car, int before = 0) {
  static const CarSpec hatchback = shipped_car("hatchback");
  return shift_advice(hatchback, car, before);
}

// Counts the changes of the light while the engine speed oscillates about `rpm` with the relative amplitude `trembles`.
// If `remembers` is false, the light has no hysteresis.
int changes(int gear, double rpm, double throttle, double trembles, bool remembers) {
  int count = 0, lit = 0, last = 0;
  for (int i = 0; i < 1000; ++i) {
    const double factor = 1.0 + trembles * std::sin(0.37 * i);
    const int now = advice(in_gear(gear, factor * rpm * 1e-3 * kKmhPerKrpm[gear - 1], throttle), remembers ? lit : 0);
    count += i > 0 && now != last ? 1 : 0;
    lit = last = now;
  }
  return count;
}

}  // namespace

TEST_CASE("up from 2500 rpm: at 20.3, 36.1, 54.3 and 72.2 km/h in the first four gears, and never in the top gear") {
  const double speeds[] = {20.30, 36.10, 54.30, 72.20};
  for (int gear = 1; gear <= 4; ++gear) {
    CAPTURE(gear);
    CHECK(advice(in_gear(gear, 1.01 * speeds[gear - 1], 0.3)) == 1);
    CHECK(advice(in_gear(gear, 0.99 * speeds[gear - 1], 0.3)) == 0);
  }
  CHECK(advice(in_gear(5, 150.0, 0.3)) == 0);
}

TEST_CASE("down below 1200 rpm under load: at 17.3, 26.1, 34.7 and 44.2 km/h, and never in first") {
  const double speeds[] = {17.33, 26.06, 34.66, 44.23};
  for (int gear = 2; gear <= 5; ++gear) {
    CAPTURE(gear);
    CHECK(advice(in_gear(gear, 0.99 * speeds[gear - 2], 0.5)) == -1);
    CHECK(advice(in_gear(gear, 1.01 * speeds[gear - 2], 0.5)) == 0);
    CHECK(advice(in_gear(gear, 0.99 * speeds[gear - 2], 0.35)) == 0);  // too little load
  }
  CHECK(advice(in_gear(1, 5.0, 0.9)) == 0);
}

TEST_CASE(
    "no advice to shift up if the next gear would lug: above 1500 rpm in second needs 2668 rpm or 21.7 km/h in first") {
  CarSpec car = shipped_car("hatchback");
  car.engine.lug_below = 1500.0 * kRpm;
  CHECK(shift_advice(car, in_gear(1, 21.4, 0.3), 0) == 0);  // 2635 rpm
  CHECK(shift_advice(car, in_gear(1, 22.0, 0.3), 0) == 1);
}

TEST_CASE("no advice to shift down if the lower gear would exceed its red line") {
  CarSpec car = shipped_car("hatchback");
  car.engine.red_line = 1600.0 * kRpm;  // second gear would need 1654 rpm
  CHECK(shift_advice(car, in_gear(3, 23.9, 0.5), 0) == 0);
  CHECK(shift_advice(car, in_gear(3, 22.0, 0.5), 0) == -1);
}

TEST_CASE("no advice with the clutch open or slipping, coasting, in neutral or reverse, or with the engine off") {
  for (const double kmh : {12.0, 45.0}) {  // [km/h] in second gear, 12 is lugging, and 45 is above 2500 rpm
    const VehicleState lit = in_gear(2, kmh, 0.5);
    REQUIRE(advice(lit) == (kmh > 20.0 ? 1 : -1));
    VehicleState car = lit;
    car.clutch_locked = false;
    CHECK(advice(car) == 0);
    car = lit;
    car.pedals.throttle = car.engine_load = 0.0;
    CHECK(advice(car, kmh > 20.0 ? 1 : -1) == 0);
    for (const int gear : {kNeutralGear, kReverseGear, 6, 9}) {
      car = lit;
      car.gear = gear;
      CHECK(advice(car) == 0);
    }
    car = lit;
    car.running = false;
    CHECK(advice(car) == 0);
  }
}

TEST_CASE("a speed that fluctuates within the hysteresis changes the light once; without hysteresis it would flicker") {
  CHECK(changes(2, 2500.0, 0.3, 0.02, true) <= 1);
  CHECK(changes(2, 2500.0, 0.3, 0.02, false) > 50);
  CHECK(changes(3, 1200.0, 0.5, 0.02, true) <= 1);
  CHECK(changes(3, 1200.0, 0.5, 0.02, false) > 50);
  CHECK(advice(in_gear(2, 34.4, 0.03), 1) == 1);    // 2382 rpm; the light goes off below 2375 rpm
  CHECK(advice(in_gear(2, 34.2, 0.03), 1) == 0);    // 2368 rpm
  CHECK(advice(in_gear(3, 27.2, 0.35), -1) == -1);  // 1252 rpm; the light goes off above 1260 rpm
  CHECK(advice(in_gear(3, 27.5, 0.35), -1) == 0);   // 1266 rpm
}

TEST_CASE("in a drive at full throttle in second gear, the driveline switches the light on at 2500 rpm") {
  const CarSpec car = shipped_car("hatchback");
  Driveline line(car);
  line.place(1500.0 * kRpm, 1500.0 * kRpm, 1.5 * kKmhPerKrpm[1] / 3.6, true);
  while (line.state().shift_advice == 0 && line.state().engine_speed < 4000.0 * kRpm)
    line.step(pedals(2, 1.0, 0.0), 1e-3);
  CHECK(line.state().shift_advice == 1);
  CHECK(line.state().engine_speed / kRpm == doctest::Approx(2500.0).epsilon(0.001));
  line.step(pedals(2, 1.0, 1.0), 1e-3);
  CHECK(line.state().shift_advice == 0);
}
