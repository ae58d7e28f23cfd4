// The rolling car against closed forms: each law with the others switched off, or their share known.
#include "app/vehicle/rolling_car.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <doctest/doctest.h>

using namespace gearshift;

namespace {

constexpr double kGravity = 9.81, kAirDensity = 1.225;

DriverControls pedals(double throttle, double brake, double clutch) {
  DriverControls controls;
  controls.ignition = true;
  controls.throttle = throttle;
  controls.brake = brake;
  controls.clutch = clutch;
  return controls;
}

// In steps of a frame of 100 Hz.
void drive(RollingCar& car, const DriverControls& controls, int gear, double seconds) {
  for (int i = 0; i < std::lround(seconds * 100.0); ++i) car.step(controls, gear, 0.01);
}

// Nothing that brakes: engine, clutch and mass are left.
RollingCarConfig frictionless() {
  RollingCarConfig config;
  config.friction_torque = config.rolling = config.drag_area = 0.0;
  return config;
}

double shaft_per_road(const RollingCarConfig& config, int gear) {
  return config.ratio[static_cast<std::size_t>(gear - 1)] * config.final_drive / config.wheel_radius;
}

// From rest, the way a person does: some revs, then the clutch up within two seconds.
void pull_away(RollingCar& car, int gear) {
  drive(car, pedals(0.4, 0.0, 1.0), gear, 0.5);
  for (int i = 0; i <= 100; ++i) drive(car, pedals(0.4, 0.0, 1.0 - 0.01 * i), gear, 0.02);
}

// On through the gears at 5000 rpm.
void accelerate_to(RollingCar& car, int top, double seconds_in_top) {
  pull_away(car, 1);
  for (int gear = 1; gear < top; ++gear) {
    for (int i = 0; i < 2000 && car.state().engine_speed < 520.0; ++i) drive(car, pedals(1.0, 0.0, 0.0), gear, 0.01);
    drive(car, pedals(0.0, 0.0, 1.0), gear, 0.2);
    drive(car, pedals(0.0, 0.0, 1.0), gear + 1, 0.2);
    for (int i = 0; i <= 20; ++i) drive(car, pedals(0.3, 0.0, 1.0 - 0.05 * i), gear + 1, 0.02);
  }
  drive(car, pedals(1.0, 0.0, 0.0), top, seconds_in_top);
}

}  // namespace

TEST_CASE("the engine idles at its idle speed, and finds it again from above") {
  RollingCar car;
  drive(car, pedals(0.0, 0.0, 0.0), kNeutralGear, 2.0);
  CHECK(car.state().engine_speed == doctest::Approx(84.0).epsilon(1e-6));
  drive(car, pedals(1.0, 0.0, 0.0), kNeutralGear, 1.0);
  CHECK(car.state().engine_speed > 300.0);
  drive(car, pedals(0.0, 0.0, 0.0), kNeutralGear, 10.0);
  CHECK(car.state().engine_speed == doctest::Approx(84.0).epsilon(1e-3));
}

// Friction a + b w alone: w(t) = (w0 + a/b) exp(-b t / J) - a/b, a = 0.4 Tf, b = 0.6 Tf / limiter.
TEST_CASE("a free engine runs down by its friction, with the time constant J / b") {
  const RollingCarConfig config;
  RollingCar car;
  drive(car, pedals(1.0, 0.0, 0.0), kNeutralGear, 2.0);
  car.step(pedals(0.0, 0.0, 0.0), kNeutralGear, 1e-9);
  const double begin = car.state().engine_speed;
  CHECK(begin > 650.0);
  drive(car, pedals(0.0, 0.0, 0.0), kNeutralGear, 2.0);
  const double b = 0.6 * config.friction_torque / config.limiter, offset = 0.4 * config.friction_torque / b;
  const double expected = (begin + offset) * std::exp(-b * 2.0 / config.engine_inertia) - offset;
  CHECK(car.state().engine_speed == doctest::Approx(expected).epsilon(1e-3));
  CHECK(expected > 150.0);  // well above idle: its control has not helped
}

TEST_CASE("the limiter holds the speed just below it, without surging") {
  RollingCar car;
  drive(car, pedals(1.0, 0.0, 0.0), kNeutralGear, 3.0);
  double lowest = 1e9, highest = 0.0;
  for (int i = 0; i < 1000; ++i) {
    car.step(pedals(1.0, 0.0, 0.0), kNeutralGear, 0.002);
    lowest = std::min(lowest, car.state().engine_speed);
    highest = std::max(highest, car.state().engine_speed);
  }
  CHECK(highest < 680.0);
  CHECK(lowest > 0.98 * 680.0);
  CHECK(highest - lowest < 1e-6);
}

// Coulomb slip: the clutch carries its capacity C until the speeds meet, after dw / (C (1/Je + 1/Jc)), Jc = m / G^2;
// the common speed is that of the whole angular momentum.
TEST_CASE("when the clutch locks, momentum is conserved, and the time to lock is that of its capacity") {
  RollingCarConfig config = frictionless();
  config.mass = 600.0;  // light, so that the common speed is above idle, whose control then gives no torque
  RollingCar car(config);
  // In second, with the clutch down, the engine near its limit, the pedal let go.
  drive(car, pedals(1.0, 0.0, 1.0), 2, 0.8);
  const double engine = car.state().engine_speed;
  REQUIRE(engine > 300.0);
  REQUIRE(car.state().road_speed == 0.0);
  const double per_road = shaft_per_road(config, 2);
  const double car_inertia = config.mass / (per_road * per_road);
  const double common = config.engine_inertia * engine / (config.engine_inertia + car_inertia);
  const double lock_time = engine / (config.clutch_capacity * (1.0 / config.engine_inertia + 1.0 / car_inertia));
  REQUIRE(common > config.idle);

  const double step = 0.0005;
  double time = 0.0;
  while (std::abs(car.state().engine_speed - per_road * car.state().road_speed) > 1e-9 && time < 10.0) {
    car.step(pedals(0.0, 0.0, 0.0), 2, step);
    time += step;
  }
  CHECK(time == doctest::Approx(lock_time).epsilon(2.0 * step / lock_time));
  CHECK(car.state().engine_speed == doctest::Approx(common).epsilon(1e-9));
  CHECK(per_road * car.state().road_speed == doctest::Approx(common).epsilon(1e-9));
  // And it stays locked.
  drive(car, pedals(0.0, 0.0, 0.0), 2, 0.5);
  CHECK(car.state().engine_speed == doctest::Approx(per_road * car.state().road_speed).epsilon(1e-9));
}

// Below its capacity a clutch that holds passes the torque on: one mass, a = T G / (m + Je G^2).
TEST_CASE("with the clutch locked, engine and car accelerate as one mass") {
  const RollingCarConfig config = frictionless();
  RollingCar car(config);
  accelerate_to(car, 3, 0.1);
  const double per_road = shaft_per_road(config, 3);
  const double from = car.state().road_speed, torque = full_torque(config, car.state().engine_speed);
  REQUIRE(car.state().engine_speed == doctest::Approx(per_road * from).epsilon(1e-9));
  car.step(pedals(1.0, 0.0, 0.0), 3, 0.002);
  const double acceleration = (car.state().road_speed - from) / 0.002;
  const double whole = config.mass + config.engine_inertia * per_road * per_road;
  CHECK(acceleration == doctest::Approx(torque * per_road / whole).epsilon(1e-6));
}

// In neutral, m v' = -k v^2 - c: v(t) = sqrt(c/k) tan(atan(v0 sqrt(k/c)) - t sqrt(k c) / m).
TEST_CASE("coasting in neutral follows the law of drag and rolling resistance, to a stop that lasts") {
  const RollingCarConfig config;
  RollingCar car;
  accelerate_to(car, 4, 10.0);
  car.step(pedals(0.0, 0.0, 1.0), kNeutralGear, 1e-9);
  const double begin = car.state().road_speed, start = car.state().distance;
  REQUIRE(begin > 25.0);
  const double k = 0.5 * kAirDensity * config.drag_area, c = config.rolling * config.mass * kGravity;
  const double phase = std::atan(begin * std::sqrt(k / c)), rate = std::sqrt(k * c) / config.mass;
  drive(car, pedals(0.0, 0.0, 0.0), kNeutralGear, 60.0);
  CHECK(car.state().road_speed == doctest::Approx(std::sqrt(c / k) * std::tan(phase - 60.0 * rate)).epsilon(1e-3));
  // The whole way: m / (2 k) ln(1 + k v0^2 / c).
  drive(car, pedals(0.0, 0.0, 0.0), kNeutralGear, phase / rate);
  CHECK(car.state().road_speed == 0.0);
  const double way = config.mass / (2.0 * k) * std::log(1.0 + k * begin * begin / c);
  CHECK(car.state().distance - start == doctest::Approx(way).epsilon(1e-3));
}

// Drive and resistance balance: k v^2 + c = G (T(w) - friction(w)), so v = sqrt((G T - c) / k) at the w that belongs to
// it. The torque curve is written out here once more.
TEST_CASE("the terminal speed is where drag and rolling resistance take what the engine gives") {
  const RollingCarConfig config;
  RollingCar car;
  accelerate_to(car, 5, 300.0);
  const double v = car.state().road_speed, w = car.state().engine_speed;
  const double before = v;
  drive(car, pedals(1.0, 0.0, 0.0), 5, 10.0);
  REQUIRE(car.state().road_speed == doctest::Approx(before).epsilon(1e-6));
  const double per_road = shaft_per_road(config, 5);
  const double off = w / 374.0 - 1.0;
  const double torque = 150.0 * (1.0 - 0.5 * off * off) - 25.0 * (0.4 + 0.6 * w / 680.0);
  const double k = 0.5 * kAirDensity * config.drag_area, c = config.rolling * config.mass * kGravity;
  CHECK(w == doctest::Approx(per_road * v).epsilon(1e-9));
  CHECK(w < 0.98 * config.limiter);  // not the limiter's doing
  CHECK(v == doctest::Approx(std::sqrt((per_road * torque - c) / k)).epsilon(1e-4));
}

TEST_CASE("with the brake down nothing moves: in gear at idle, in neutral, in reverse, with the hand brake alone") {
  for (const int gear : {1, kNeutralGear, kReverseGear}) {
    CAPTURE(gear);
    RollingCar car;
    drive(car, pedals(0.0, 1.0, 1.0), gear, 0.5);
    for (int i = 0; i < 500; ++i) drive(car, pedals(0.0, 1.0, std::max(0.0, 1.0 - 0.004 * i)), gear, 0.01);
    CHECK(car.state().road_speed == 0.0);
    CHECK(car.state().distance == 0.0);
    CHECK(car.state().stalled == (gear != kNeutralGear));
  }
  RollingCar parked;
  DriverControls controls = pedals(0.0, 0.0, 0.0);
  controls.hand_brake = 1.0;
  drive(parked, controls, kNeutralGear, 60.0);
  CHECK(parked.state().distance == 0.0);
}

TEST_CASE("without a brake a slipping clutch at idle does move it: the brake was what held it") {
  RollingCar car;
  drive(car, pedals(0.0, 0.0, 1.0), 1, 0.5);
  drive(car, pedals(0.0, 0.0, 0.9), 1, 1.0);
  CHECK(car.state().distance > 0.1);
  CHECK_FALSE(car.state().stalled);
}

// v^2 = 2 a s with a = (brake + rolling) / m, drag switched off, clutch down.
TEST_CASE("braking takes the distance that its force needs, and ends at rest without a swing back") {
  RollingCarConfig config;
  config.drag_area = 0.0;
  RollingCar car(config);
  accelerate_to(car, 3, 1.0);
  const double begin = car.state().road_speed, start = car.state().distance;
  double slowest = begin;
  for (int i = 0; i < 2000; ++i) {
    car.step(pedals(0.0, 1.0, 1.0), 3, 0.01);
    slowest = std::min(slowest, car.state().road_speed);
  }
  const double force = config.brake_force + config.rolling * config.mass * kGravity;
  CHECK(car.state().distance - start == doctest::Approx(0.5 * config.mass * begin * begin / force).epsilon(1e-3));
  CHECK(slowest == 0.0);
}

TEST_CASE("reverse drives backwards") {
  RollingCar car;
  pull_away(car, kReverseGear);
  CHECK(car.state().road_speed < -1.0);
  CHECK(car.state().distance < 0.0);
  CHECK(car.state().engine_speed > 0.0);
}

TEST_CASE("a clutch dropped at rest without throttle stalls the engine; the starter brings it back") {
  RollingCar car;
  drive(car, pedals(0.0, 0.0, 1.0), 3, 0.5);
  drive(car, pedals(0.0, 0.0, 0.0), 3, 1.0);
  CHECK(car.state().stalled);
  drive(car, pedals(0.0, 0.0, 0.0), 3, 10.0);
  CHECK(car.state().engine_speed == 0.0);
  CHECK(car.state().road_speed == 0.0);
  CHECK(car.state().engine_load == 0.0);

  DriverControls start = pedals(0.0, 0.0, 1.0);
  start.starter = true;
  drive(car, start, 3, 1.0);
  drive(car, pedals(0.0, 0.0, 1.0), 3, 3.0);
  CHECK_FALSE(car.state().stalled);
  CHECK(car.state().engine_speed == doctest::Approx(84.0).epsilon(1e-3));
}

TEST_CASE("without ignition the engine runs down and the starter does not turn it") {
  RollingCar car;
  DriverControls off = pedals(1.0, 0.0, 0.0);
  off.ignition = false;
  off.starter = true;
  drive(car, off, kNeutralGear, 10.0);
  CHECK(car.state().engine_speed == 0.0);
  CHECK_FALSE(car.state().stalled);  // it was switched off
  CHECK_FALSE(car.state().ignition);
}

TEST_CASE("the engine never turns backwards, whatever the wheels want") {
  RollingCar car;
  pull_away(car, kReverseGear);
  drive(car, pedals(0.0, 0.0, 1.0), 1, 0.1);  // rolling backwards, into first
  REQUIRE(car.state().road_speed < -1.0);
  for (int i = 0; i < 500; ++i) {
    car.step(pedals(0.0, 0.0, 0.0), 1, 0.01);
    CHECK(car.state().engine_speed >= 0.0);
  }
  CHECK(car.state().road_speed == 0.0);  // the clutch has braked it
}

TEST_CASE(
    "dogs rattle until their speeds meet: the clutch lets a forward gear in, reverse waits for the car to stand") {
  RollingCar car;
  drive(car, pedals(0.0, 0.0, 0.0), 1, 0.5);  // at idle, clutch up
  CHECK(car.state().grinding);
  CHECK(car.state().road_speed == 0.0);
  CHECK_FALSE(car.state().stalled);
  drive(car, pedals(0.0, 0.0, 1.0), 1, 0.1);
  CHECK_FALSE(car.state().grinding);

  RollingCar fast;
  accelerate_to(fast, 3, 1.0);
  drive(fast, pedals(0.0, 0.0, 1.0), kNeutralGear, 0.1);
  CHECK_FALSE(fast.state().grinding);
  drive(fast, pedals(0.0, 0.0, 1.0), kReverseGear, 0.5);
  CHECK(fast.state().grinding);
  CHECK(fast.state().road_speed > 10.0);
  drive(fast, pedals(0.0, 1.0, 1.0), kReverseGear, 5.0);
  CHECK_FALSE(fast.state().grinding);
}

// The third gear's speed at the clutch is met by the throttle alone.
TEST_CASE("matched revs let a gear in without the clutch") {
  const RollingCarConfig config;
  RollingCar car;
  accelerate_to(car, 3, 2.0);
  drive(car, pedals(0.0, 0.0, 0.0), kNeutralGear, 0.05);
  const double matched = shaft_per_road(config, 4) * car.state().road_speed;
  REQUIRE(car.state().engine_speed > matched + 50.0);
  drive(car, pedals(0.0, 0.0, 0.0), 4, 0.05);
  CHECK(car.state().grinding);
  drive(car, pedals(0.0, 0.0, 0.0), 4, 3.0);  // the revs fall
  CHECK_FALSE(car.state().grinding);
  CHECK(car.state().engine_speed == doctest::Approx(shaft_per_road(config, 4) * car.state().road_speed).epsilon(1e-6));
}

// At 30 km/h every forward gear turns the engine above idle and below the limiter.
TEST_CASE("a car that rolls at 30 km/h takes each of five gears in turn, the clutch up in a quarter of a second") {
  RollingCarConfig config;
  config.start_speed = 30.0 / 3.6;
  RollingCar car(config);
  CHECK(car.state().road_speed == config.start_speed);
  for (int gear = 1; gear <= 5; ++gear) {
    CAPTURE(gear);
    drive(car, pedals(0.0, 0.0, 1.0), kNeutralGear, 0.5);
    drive(car, pedals(0.0, 0.0, 1.0), gear, 0.1);
    for (int i = 0; i <= 25; ++i) drive(car, pedals(0.5, 0.0, 1.0 - 0.04 * i), gear, 0.01);
    drive(car, pedals(0.5, 0.0, 0.0), gear, 0.5);
    CHECK_FALSE(car.state().stalled);
    CHECK(car.state().engine_speed == doctest::Approx(shaft_per_road(config, gear) * car.state().road_speed));
    CHECK(car.state().engine_speed > config.idle);
  }
}

TEST_CASE("how a second is cut into frames changes little, and the same cut gives the same bits") {
  RollingCar coarse, fine, again;
  for (RollingCar* car : {&coarse, &fine, &again}) drive(*car, pedals(0.0, 0.0, 1.0), 1, 0.2);
  for (int i = 0; i < 40; ++i) coarse.step(pedals(0.5, 0.0, 0.5), 1, 0.05);
  for (int i = 0; i < 2000; ++i) fine.step(pedals(0.5, 0.0, 0.5), 1, 0.001);
  for (int i = 0; i < 40; ++i) again.step(pedals(0.5, 0.0, 0.5), 1, 0.05);
  CHECK(coarse.state().road_speed == doctest::Approx(fine.state().road_speed).epsilon(1e-3));
  CHECK(coarse.state().road_speed == again.state().road_speed);
}

TEST_CASE("what is no number, negative or too long moves nothing wrong") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  RollingCar car;
  car.step(pedals(nan, nan, nan), 77, 1e9);
  car.step(pedals(-5.0, 7.0, -1.0), -9, nan);
  car.step(pedals(0.0, 0.0, 0.0), 0, -1.0);
  CHECK(std::isfinite(car.state().engine_speed));
  CHECK(std::isfinite(car.state().road_speed));
  CHECK(car.state().brake == 0.0);
  CHECK(car.state().throttle == 0.0);
}
