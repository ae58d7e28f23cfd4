// The driveline compared with closed forms. Each law is tested with the other laws switched off.
#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "app/lab/bench/driveline/driveline_rig.h"
#include "tests/app/vehicle/cars.h"

using namespace gearshift::lab;
using namespace gearshift::vehicle;
using doctest::Approx;
using gearshift::test::slip;

namespace {

// [1] relative error.
double relative_error(double actual, double expected) {
  return std::abs(actual / expected - 1.0);
}

bool is_locked(const Driveline& line) {
  return line.state().clutch_locked;
}
bool is_stopped(const Driveline& line) {
  return line.state().road_speed == 0.0;
}

DrivelineInput engine_off(int gear, double clutch) {
  DrivelineInput in = pedals(gear, 0.0, clutch);
  in.ignition = false;
  return in;
}

}  // namespace

// A clutch with the torque T locks two inertias J1 and J2 after t = Jr dw / T. Here dw is their speed difference, and
// Jr = J1 J2 / (J1 + J2) is their reduced inertia. The clutch heat is Jr dw^2 / 2 for any torque. The common speed
// follows from the total momentum.
TEST_CASE("two free inertias lock after Jr dw / T, at the speed of their common momentum, and lose Jr dw^2 / 2") {
  for (const double step : {0.001, 0.0042, 0.011, 0.033}) {
    CAPTURE(step);
    Driveline line(bare_car(0.15, 0.569, 200.0));
    line.place(300.0, 30.0, 3.0, false);
    const double time = time_until(line, engine_off(1, 0.0), step, is_locked);
    CHECK(relative_error(time, 0.160254) < 1e-5);
    CHECK(relative_error(time, 0.15 * 0.569 / 0.719 * 270.0 / 200.0) < 1e-9);
    CHECK(relative_error(line.energy().clutch, 4326.85) < 1e-6);
    CHECK(relative_error(line.energy().clutch, 0.5 * 0.15 * 0.569 / 0.719 * 270.0 * 270.0) < 1e-9);
    CHECK(relative_error(line.state().engine_speed, (0.15 * 300.0 + 0.569 * 30.0) / 0.719) < 1e-12);
    CHECK(slip(line) == 0.0);
  }
}

TEST_CASE("inertias with ratios of 1 to 100 and 100 to 1 lock by the same law") {
  for (const double one : {0.05, 5.0}) {
    const double other = 0.25 / one, reduced = one * other / (one + other);
    Driveline line(bare_car(one, other, 100.0));
    line.place(400.0, 0.0, 0.0, false);
    const double time = time_until(line, engine_off(1, 0.0), 0.001, is_locked);
    CHECK(relative_error(time, reduced * 400.0 / 100.0) < 1e-9);
    CHECK(relative_error(line.energy().clutch, 0.5 * reduced * 400.0 * 400.0) < 1e-9);
  }
}

// The clutch torque T and the load torques T1 and T2 act on the inertias J1 and J2, whose reduced inertia is Jr. If the
// initial speed difference is dw, the clutch locks after t = dw / (T / Jr - T1 / J1 - T2 / J2),
// and its heat is T dw t / 2.
TEST_CASE("with loads on both sides the clutch locks later, and loses T dw t / 2") {
  CarSpec car = bare_car(0.15, 0.569, 200.0, 60.0);
  car.body.resistance = 40.0 * kPerRoad;
  Driveline line(car);
  line.place(300.0, 30.0, 3.0, true);
  const double rate = 200.0 * (1.0 / 0.15 + 1.0 / 0.569) - 60.0 / 0.15 - 40.0 / 0.569;
  const double time = time_until(line, pedals(1, 1.0, 0.0), 0.001, is_locked);
  CHECK(relative_error(time, 270.0 / rate) < 1e-9);
  // The clutch locked within the last step. For the rest of that step it adds no heat.
  CHECK(relative_error(line.energy().clutch, 200.0 * 270.0 * 270.0 / rate / 2.0) < 1e-9);
}

TEST_CASE("a clutch whose capacity is too small for the loads never locks, and its slip grows linearly") {
  CarSpec car = bare_car(0.15, 0.569, 50.0, 120.0);
  car.body.resistance = 40.0 * kPerRoad;
  Driveline line(car);
  line.place(300.0, 30.0, 3.0, true);
  const double rate = 50.0 * (1.0 / 0.15 + 1.0 / 0.569) - 120.0 / 0.15 - 40.0 / 0.569;
  REQUIRE(rate < 0.0);
  drive(line, pedals(1, 1.0, 0.0), 2.0);
  CHECK_FALSE(is_locked(line));
  CHECK(relative_error(slip(line), 270.0 - rate * 2.0) < 1e-9);
}

// The pedal goes from the bite point to the closed point in the time T (here 1 s). So the clutch's capacity is
// C (t / T)^2, where C is the capacity of the closed clutch. The clutch locks when its angular impulse C t^3 / (3 T^2)
// equals Jr dw, with the reduced inertia Jr and the initial speed difference dw.
TEST_CASE("with a pedal released at constant speed the clutch locks after the cube root of 3 Jr dw T^2 / C") {
  const CarSpec car = bare_car(0.15, 0.569, 240.0);
  Driveline line(car);
  line.place(200.0, 0.0, 0.0, false);
  const double reduced = 0.15 * 0.569 / 0.719;
  const auto foot = [&](double t) {
    return engine_off(1, car.clutch.bite - (car.clutch.bite - car.clutch.closed) * t);
  };
  const double time = time_until(line, foot, 0.001, is_locked);
  CHECK(relative_error(time, std::cbrt(3.0 * reduced * 200.0 / 240.0)) < 1e-6);
  CHECK(relative_error(line.energy().clutch, 0.5 * reduced * 200.0 * 200.0) < 1e-9);
}

// With the reduced inertia Jr and the speed difference dw, the clutch locks at t = sqrt(2 Jr dw / k).
// Its heat is Jr dw^2 / 2.
TEST_CASE("with a capacity that grows as k t the clutch locks after sqrt(2 Jr dw / k)") {
  const CarSpec car = bare_car(0.15, 0.569, 240.0);
  const double reduced = 0.15 * 0.569 / 0.719, k = 400.0;
  const auto foot = [&](double t) {
    const double fraction = std::sqrt(k * t / car.clutch.capacity);
    return engine_off(1, car.clutch.bite - (car.clutch.bite - car.clutch.closed) * fraction);
  };
  Driveline line(car);
  line.place(200.0, 0.0, 0.0, false);
  const double time = time_until(line, foot, 0.001, is_locked);
  CHECK(relative_error(time, std::sqrt(2.0 * reduced * 200.0 / k)) < 1e-4);
  CHECK(relative_error(line.energy().clutch, 0.5 * reduced * 200.0 * 200.0) < 1e-9);
}

TEST_CASE("a locked clutch transmits (T1 J2 + T2 J1) / (J1 + J2)") {
  CarSpec car = bare_car(0.15, 0.569, 200.0, 120.0);
  car.body.resistance = 30.0 * kPerRoad;
  Driveline line(car);
  line.place(100.0, 100.0, 10.0, true);
  drive(line, pedals(1, 1.0, 0.0), 0.1);
  CHECK(is_locked(line));
  CHECK(relative_error(line.state().clutch_torque, (120.0 * 0.569 + 30.0 * 0.15) / 0.719) < 1e-12);
  CHECK(relative_error(line.state().acceleration, (120.0 - 30.0) / 0.719 / kPerRoad) < 1e-12);
  CHECK(line.energy().clutch == 0.0);
}

// The throttle opens within one second, so the engine's torque is T1 = 200 t. With the inertias J1 of the engine and J2
// of the car, the clutch must transmit T1 J2 / (J1 + J2). It slips when this torque reaches its capacity.
TEST_CASE("a locked clutch slips when it would have to transmit more than its capacity, and not before") {
  Driveline line(bare_car(0.15, 0.569, 100.0, 200.0));
  line.place(50.0, 50.0, 5.0, true);
  const auto foot = [](double t) { return pedals(1, std::min(t, 1.0), 0.0); };
  const double time = time_until(line, foot, 0.001, [](const Driveline& l) { return slip(l) > 0.0; });
  CHECK(relative_error(time, 100.0 * 0.719 / 0.569 / 200.0) < 1e-5);
  CHECK(line.state().clutch_torque == 100.0);
}

// Rounding errors could make this clutch alternate between slipping and locking.
TEST_CASE("a clutch that must transmit exactly its capacity stays locked") {
  for (int i = 0; i < 50; ++i) {
    const double torque = 60.0 + 1.7 * i, other = 0.4 + 0.013 * i;
    Driveline line(bare_car(0.15, other, torque * other / (0.15 + other), torque));
    line.place(100.0, 100.0, 10.0, true);
    bool held = true;
    for (int n = 0; n < 200; ++n) {
      line.step(pedals(1, 1.0, 0.0), 0.001);
      held = held && is_locked(line);
    }
    CHECK(held);
  }
}

// The car's speed v follows m v' = -(a + c v^2), with the mass m and the resistance coefficients a and c.
// From the speed v0, the car stops after the time t = (m / sqrt(a c)) * atan(v0 * sqrt(c / a))
// and the distance d = (m / (2 c)) * ln(1 + c v0^2 / a).
TEST_CASE(
    "the car coasts to rest after the time and distance that its resistance gives, forwards and backwards alike") {
  CarSpec car;
  car.body.mass = 1412.8 - car.body.rotating;
  REQUIRE(car.body.resistance == 128.19);
  REQUIRE(car.body.resistance_square == 0.4764);
  const double expected[][3] = {{30.0, 193.52, 2178.2}, {10.0, 98.97, 468.6}};
  for (const auto& [speed, seconds, metres] : expected) {
    for (const double direction : {1.0, -1.0}) {
      Driveline line(car);
      line.place(84.0, 0.0, direction * speed, true);
      const double time = time_until(line, pedals(0, 0.0, 1.0), 0.001, is_stopped);
      CHECK(std::abs(time - seconds) < 0.005);
      CHECK(std::abs(direction * line.state().distance - metres) < 0.05);
      CHECK(relative_error(time, 1412.8 / std::sqrt(128.19 * 0.4764) * std::atan(speed * std::sqrt(0.4764 / 128.19))) <
            1e-8);
      CHECK(relative_error(direction * line.state().distance,
                           1412.8 / 2.0 / 0.4764 * std::log1p(0.4764 * speed * speed / 128.19)) < 1e-8);
      drive(line, pedals(0, 0.0, 1.0), 1.0);
      CHECK(line.state().road_speed == 0.0);
    }
  }
}

// The car's speed v follows m v' = -(a + b v + c v^2), with the mass m and the resistance coefficients a, b and c.
// If 4 a c > b^2, then with D = sqrt(4 a c - b^2) the car stops from the speed v0 after
// t = (2 m / D) * (atan((2 c v0 + b) / D) - atan(b / D)).
TEST_CASE("with a linear resistance term too, the car stops at the time from the Riccati equation") {
  CarSpec car;
  car.body.mass = 1412.8 - car.body.rotating;
  car.body.resistance_slope = 0.954;
  const double d = std::sqrt(4.0 * 128.19 * 0.4764 - 0.954 * 0.954);
  Driveline line(car);
  line.place(84.0, 0.0, 30.0, true);
  const double time = time_until(line, pedals(0, 0.0, 1.0), 0.001, is_stopped);
  const double expected = 2.0 * 1412.8 / d * (std::atan((2.0 * 0.4764 * 30.0 + 0.954) / d) - std::atan(0.954 / d));
  CHECK(relative_error(time, expected) < 1e-8);
}

// The car has the mass m and the resistance coefficients a, b and c. If 4 a c < b^2, then with D = sqrt(b^2 - 4 a c)
// the car stops from the speed v0 after
// t = (m / D) * ln(((2 c v0 + b - D) * (b + D)) / ((2 c v0 + b + D) * (b - D))).
TEST_CASE("the Riccati equation also gives the time if the linear term dominates") {
  CarSpec car;
  car.body.mass = 1000.0 - car.body.rotating;
  car.body.resistance = 50.0;
  car.body.resistance_slope = 40.0;
  car.body.resistance_square = 0.4;
  const double b = 40.0, d = std::sqrt(b * b - 4.0 * 50.0 * 0.4), end = 2.0 * 0.4 * 20.0 + b;
  Driveline line(car);
  line.place(84.0, 0.0, 20.0, true);
  const double time = time_until(line, pedals(0, 0.0, 1.0), 0.001, is_stopped);
  CHECK(relative_error(time, 1000.0 / d * std::log((end - d) * (b + d) / ((end + d) * (b - d)))) < 1e-8);
}

// The engine's speed w follows J w' = -(a + c w^2), with the inertia J and the friction coefficients a and c.
TEST_CASE("an engine that is switched off slows down by its friction and stops completely") {
  CarSpec car = bare_car(0.15, 0.5, 0.0);
  car.engine.friction = 9.0;
  car.engine.friction_square = 4e-5;
  Driveline line(car);
  line.place(400.0, 0.0, 0.0, true);
  const double time =
      time_until(line, engine_off(0, 1.0), 0.001, [](const Driveline& l) { return l.state().engine_speed == 0.0; });
  CHECK(relative_error(time, 0.15 / std::sqrt(9.0 * 4e-5) * std::atan(400.0 * std::sqrt(4e-5 / 9.0))) < 1e-7);
  drive(line, engine_off(0, 1.0), 1.0);
  CHECK(line.state().engine_speed == 0.0);
}

// The engine's torque is k (idle - w) F, with the idle gain k, the speed w, and the sum F of full torque and friction.
// So (idle - w) falls as exp(-k F t / J), where J is the engine's inertia.
TEST_CASE("from below, the engine returns to idle speed as exp(-k F t / J)") {
  CarSpec car = bare_car(0.15, 0.5, 0.0, 91.0);
  car.engine.friction = 9.0;
  car.engine.idle = 84.0;
  car.engine.idle_gain = 0.01;
  Driveline line(car);
  line.place(74.0, 0.0, 0.0, true);
  drive(line, pedals(0, 0.0, 1.0), 0.3);
  CHECK(relative_error(84.0 - line.state().engine_speed, 10.0 * std::exp(-0.01 * 100.0 * 0.3 / 0.15)) < 1e-4);
  drive(line, pedals(0, 0.0, 1.0), 10.0);
  CHECK(line.state().engine_speed == Approx(84.0).epsilon(1e-12));
}

// The car is so heavy that its speed stays constant. So the shaft reaches its gear's speed after
// t = J dw / (T +- drag), with its inertia J, the speed difference dw, and the cone's torque T at the shaft.
TEST_CASE("a cone brings the shaft to its gear's speed in J dw / (T +- drag), with the drag for or against it") {
  CarSpec car = bare_car(0.15, 1.0, 240.0);
  car.gearbox.ratio = {2.0};
  car.body.mass = 1e12;
  car.gearbox.drag = 0.8;
  const double target = 20.0 * 5.0;  // [rad/s] speed that the shaft must have at 5 m/s
  for (const double begin : {250.0, 30.0}) {
    Driveline line(car);
    line.place(0.0, begin, 5.0, false);
    DrivelineInput in = engine_off(0, 1.0);
    in.cone_gear = 1;
    in.cone_torque = 11.4;
    const double time = time_until(
        line, in, 0.001, [&](const Driveline& l) { return l.state().shaft_speed == 20.0 * l.state().road_speed; });
    const double torque = 11.4 / 2.0 + (begin > target ? 0.8 : -0.8);
    CHECK(relative_error(time, 0.006 * std::abs(begin - target) / torque) < 1e-9);
    CHECK(relative_error(line.energy().cone, 11.4 / 2.0 * std::abs(begin - target) * time / 2.0) < 1e-9);
    drive(line, in, 1.0);
    // Once the cone has matched the speeds of shaft and gear, they stay exactly equal.
    CHECK(line.state().shaft_speed == 20.0 * line.state().road_speed);
  }
}

TEST_CASE("with the clutch up the cone must accelerate the engine too") {
  CarSpec car = bare_car(0.15, 1.0, 240.0);
  car.gearbox.ratio = {2.0};
  car.body.mass = 1e12;
  Driveline line(car);
  line.place(250.0, 250.0, 5.0, false);
  DrivelineInput in = engine_off(0, 0.0);
  in.cone_gear = 1;
  in.cone_torque = 11.4;
  const double time = time_until(
      line, in, 0.001, [](const Driveline& l) { return l.state().shaft_speed == 20.0 * l.state().road_speed; });
  CHECK(relative_error(time, 0.156 * 150.0 / 5.7) < 1e-9);
  CHECK(slip(line) == 0.0);
}

TEST_CASE("a cone weaker than the engine's torque never brings the speeds together") {
  CarSpec car = bare_car(0.15, 1.0, 240.0, 50.0);
  car.gearbox.ratio = {2.0};
  Driveline line(car);
  line.place(250.0, 250.0, 5.0, true);
  DrivelineInput in = pedals(0, 1.0, 0.0);
  in.cone_gear = 1;
  in.cone_torque = 11.4;
  drive(line, in, 2.0);
  CHECK(line.state().shaft_speed > 500.0);
}

// The clutch's torque is limited, so the clutch transmits no impulse. Only shaft and car take part in the impact.
TEST_CASE("dogs that engage conserve the momentum of shaft and car, and lose Jr dw^2 / 2") {
  for (const double clutch : {1.0, 0.0}) {
    Driveline line(bare_car(0.15, 0.306, 200.0));
    line.place(100.0, 100.0, 3.0, false);
    line.step(engine_off(1, clutch), 0.0);
    const double disc = 0.006, rest = 0.3, reduced = disc * rest / (disc + rest);
    CHECK(relative_error(line.state().shaft_speed, (disc * 100.0 + rest * 30.0) / (disc + rest)) < 1e-12);
    CHECK(line.state().road_speed * kPerRoad == Approx(line.state().shaft_speed).epsilon(1e-15));
    CHECK(relative_error(line.energy().mesh, 0.5 * reduced * 70.0 * 70.0) < 1e-12);
    CHECK(line.state().engine_speed == 100.0);
  }
}
