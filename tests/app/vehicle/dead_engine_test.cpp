// A dead engine: its compression holds a parked car both ways, a rolling car turns it in either direction, and starts it.
#include <algorithm>
#include <cmath>
#include <string>

#include <doctest/doctest.h>

#include "app/lab/bench/driveline/driveline_rig.h"
#include "tests/app/vehicle/cars.h"

using namespace gearshift::haptics;
using namespace gearshift::lab;
using namespace gearshift::test;
using namespace gearshift::vehicle;
using doctest::Approx;

namespace {

DrivelineInput parked(int gear, double slope_percent, double clutch = 0.0) {
  DrivelineInput in = pedals(gear, 0.0, clutch);
  in.ignition = false;
  in.slope = std::atan(slope_percent / 100.0);
  return in;
}

}  // namespace

TEST_CASE("parked in first or reverse with the engine off, a car stays on 15 % both ways, and rolls from 30 %") {
  for (const char* name : {"hatchback", "diesel"}) {
    const CarSpec car = shipped_car(name);
    for (const int gear : {1, kReverseGear}) {
      for (const double slope : {-30.0, -15.0, -10.0, 10.0, 15.0, 30.0}) {
        CAPTURE(name);
        CAPTURE(gear);
        CAPTURE(slope);
        Driveline line(car);
        line.place(0.0, 0.0, 0.0, false);
        drive(line, parked(gear, slope), 20.0);
        const double way = line.state().distance;
        if (std::abs(slope) < 20.0)
          CHECK(way == 0.0);
        else
          CHECK(way * slope < -100.0);  // further than 3 m, downhill
        CHECK(line.fallbacks() == 0);
      }
    }
  }
}

// At rest the engine holds up to its friction and compression T. So a car in gear rolls from the slope on where
// m g sin a exceeds rolling resistance and (T + drag) G / efficiency.
TEST_CASE("the steepest slope that compression holds is where the torques balance") {
  const CarSpec car = shipped_car("hatchback");
  for (const int gear : {1, 2, kReverseGear}) {
    const double torque = friction_torque(car.engine, 0.0) + car.gearbox.drag;
    const double force = torque * std::abs(shaft_per_road(car, gear)) / car.gearbox.efficiency + car.body.resistance;
    const double steepest = std::asin(force / (car.body.mass * 9.81));
    for (const double sense : {-1.0, 1.0}) {
      for (const double fraction : {0.999, 1.001}) {
        Driveline line(car);
        line.place(0.0, 0.0, 0.0, false);
        DrivelineInput in = parked(gear, 0.0);
        in.slope = sense * fraction * steepest;
        drive(line, in, 5.0);
        CHECK((line.state().distance == 0.0) == (fraction < 1.0));
      }
    }
  }
}

TEST_CASE("a car that rolls back in first turns its dead engine backwards, and forwards in reverse") {
  const CarSpec car = shipped_car("hatchback");
  for (const int gear : {1, kReverseGear}) {
    Driveline line(car);
    line.place(0.0, 0.0, 0.0, false);
    drive(line, parked(gear, 30.0, 1.0), 1.0);
    CHECK(line.state().road_speed < -2.0);
    CHECK(line.state().engine_speed == 0.0);
    for (int i = 0; i < 300; ++i) line.step(parked(gear, 30.0, 1.0 - i / 300.0), 0.001);
    drive(line, parked(gear, 30.0), 1.0);
    CHECK(line.state().clutch_locked);
    CHECK(line.state().engine_speed == Approx(shaft_per_road(car, gear) * line.state().road_speed));
    CHECK(line.state().engine_speed * (gear == 1 ? -1.0 : 1.0) > 50.0);
    CHECK_FALSE(line.state().running);
  }
}

TEST_CASE(
    "a bump start from second at 15 km/h with the ignition on; not without it, and not at walking pace in fifth") {
  struct Case {
    int gear;
    double km_per_h;
    bool ignition, starts;
  };
  const CarSpec car = shipped_car("hatchback");
  for (const Case& c :
       {Case{2, 15.0, true, true}, Case{2, 10.0, true, true}, Case{2, 15.0, false, false}, Case{5, 5.0, true, false}}) {
    CAPTURE(c.gear);
    CAPTURE(c.km_per_h);
    Driveline line(car);
    line.place(0.0, shaft_per_road(car, c.gear) * c.km_per_h / 3.6, c.km_per_h / 3.6, false, true);
    for (int i = 0; i < 500; ++i) {
      DrivelineInput in = pedals(c.gear, 0.1, 1.0 - i / 500.0);
      in.ignition = c.ignition;
      line.step(in, 0.001);
    }
    DrivelineInput in = pedals(c.gear, 0.1, 0.0);
    in.ignition = c.ignition;
    drive(line, in, 3.0);
    CHECK(line.state().running == c.starts);
    if (c.starts) CHECK(line.state().road_speed > 1.5);
  }
}

// The engine turns with constant torque up to the firing angle: w^2 = 2 T a / J. The event is found inside a step.
TEST_CASE("the starter's catch is found inside the step, the same for steps of 1 ms and 4 ms") {
  CarSpec car = bare_car(0.15, 0.5, 0.0, 100.0);
  car.engine.stall = 30.0;
  car.engine.starter_torque = 6.0;
  car.engine.starter_speed = 1e7;  // so that the torque hardly falls
  car.engine.idle_gain = 0.01;
  car.engine.idle = 300.0;
  for (const double step : {0.001, 0.004}) {
    Driveline line(car);
    line.place(0.0, 0.0, 0.0, false);
    DrivelineInput in = pedals(0, 0.0, 1.0);
    in.starter = true;
    const double fires = time_until(line, in, step, [](const Driveline& l) { return l.state().running; });
    // From rest, w = T t / J reaches the stall speed, 30 rad/s, at 0.75 s and 11.25 rad; 12.57 rad after
    // sqrt(2 J a / T) = 0.7928 s.
    CHECK(fires == Approx(std::sqrt(2.0 * 0.15 * 12.57 / 6.0)).epsilon(1e-4));
  }
}
