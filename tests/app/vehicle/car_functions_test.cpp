// The car's curves and the engine's control, compared with values that were computed by hand.
#include <cmath>

#include <doctest/doctest.h>

#include "app/vehicle/driveline.h"
#include "app/vehicle/engine_control.h"

using namespace gearshift::haptics;
using namespace gearshift::vehicle;
using doctest::Approx;

namespace {

EngineSpec small_engine() {
  EngineSpec engine;
  engine.full_load[0] = {100.0, 60.0};
  engine.full_load[1] = {200.0, 100.0};
  engine.full_load[2] = {600.0, 20.0};
  engine.points = 3;
  engine.friction = 8.0;
  engine.friction_slope = 0.01;
  engine.friction_square = 1e-4;
  engine.idle = 150.0;
  engine.idle_gain = 0.01;
  engine.stall = 90.0;
  engine.limiter = 500.0;
  engine.limiter_band = 20.0;
  return engine;
}

}  // namespace

TEST_CASE("full torque: straight between its points, none beyond") {
  const EngineSpec engine = small_engine();
  const double expected[][2] = {{99.0, 0.0},   {100.0, 60.0}, {150.0, 80.0}, {200.0, 100.0},
                                {400.0, 60.0}, {600.0, 20.0}, {601.0, 0.0}};
  for (const auto& [speed, torque] : expected) CHECK(full_torque(engine, speed) == Approx(torque));
  CHECK(full_torque(engine, std::nan("")) == 0.0);
  CHECK(full_torque(EngineSpec{}, 100.0) == 0.0);
}

TEST_CASE("friction: constant, linear and square") {
  CHECK(friction_torque(small_engine(), 0.0) == 8.0);
  CHECK(friction_torque(small_engine(), 200.0) == Approx(14.0));
  CHECK(friction_torque(small_engine(), -200.0) == Approx(14.0));  // against either direction
}

TEST_CASE("compression holds an engine at rest, and is gone once it turns") {
  EngineSpec engine = small_engine();
  engine.compression = 40.0;
  CHECK(friction_torque(engine, 0.0) == 48.0);
  CHECK(friction_torque(engine, -4.0) == Approx(8.0 + 0.04 + 0.0016 + 40.0 * std::exp(-1.0)));
  CHECK(friction_torque(engine, 200.0) == Approx(14.0).epsilon(1e-12));
}

TEST_CASE("clutch: nothing down to the bite, a quarter half-way, all from closed on") {
  ClutchSpec clutch;
  clutch.capacity = 240.0;
  clutch.bite = 0.75;
  clutch.closed = 0.15;
  const double expected[][2] = {{1.0, 0.0}, {0.75, 0.0}, {0.45, 60.0}, {0.15, 240.0}, {0.0, 240.0}};
  for (const auto& [pedal, torque] : expected) CHECK(clutch_capacity(clutch, pedal) == Approx(torque));
}

TEST_CASE("shaft per road: ratio times final drive over radius, reverse below nothing, none in neutral") {
  CarSpec car;
  car.gearbox.ratio = {3.0, 2.0};
  car.gearbox.reverse = 3.5;
  car.gearbox.final_drive = 4.0;
  car.body.wheel_radius = 0.25;
  CHECK(shaft_per_road(car, 1) == Approx(48.0));
  CHECK(shaft_per_road(car, kReverseGear) == Approx(-56.0));
  for (const int none : {kNeutralGear, 3, 10, -2}) CHECK(shaft_per_road(car, none) == 0.0);
}

TEST_CASE("the engine idles at its idle speed: combustion there is friction") {
  const EngineSpec engine = small_engine();
  const EngineControl control(engine);
  CHECK(control.torque(150.0, 0.0) == Approx(friction_torque(engine, 150.0)).epsilon(1e-14));
  CHECK(control.torque(140.0, 0.0) > friction_torque(engine, 140.0));
  CHECK(control.torque(250.0, 0.0) == 0.0);
  CHECK(control.torque(250.0, 1.0) == Approx(full_torque(engine, 250.0) + friction_torque(engine, 250.0)));
}

TEST_CASE("an engine dies below its stall speed and stays dead, until it has been turned far and fast enough") {
  EngineControl control(small_engine());
  const auto turn = [&](double angle) { control.set_state({0.0, 0.0, angle}); };
  control.update(89.0);
  CHECK_FALSE(control.running());
  control.update(300.0);
  CHECK_FALSE(control.running());
  CHECK(control.torque(300.0, 1.0) == 0.0);
  CHECK(control.state_rate(20.0, 0.0, {}).cranked == 20.0);
  CHECK(control.state_rate(-20.0, 0.0, {}).cranked == 0.0);
  turn(12.5);  // two turns are 12.566
  control.turn_key(true, true);
  control.update(15.0);
  CHECK_FALSE(control.running());
  turn(12.6);
  control.update(14.0);
  CHECK_FALSE(control.running());
  CHECK(control.torque(0.0, 0.0) == 60.0);
  CHECK(control.torque(15.0, 0.0) == 30.0);
  CHECK(control.torque(-15.0, 0.0) == 60.0);
  CHECK(control.would_change(15.0, control.state()));
  control.update(15.0);
  CHECK(control.running());
  control.turn_key(true, false);
  control.update(15.0);
  CHECK_FALSE(control.running());
  control.turn_key(true, true);  // the starter must again turn the engine twice
  control.update(15.0);
  CHECK_FALSE(control.running());
}

TEST_CASE("without the starter, a turned engine fires from its stall speed on; one that stood still must turn again") {
  EngineControl control(small_engine());
  control.set(false, true);
  control.set_state({0.0, 0.0, 20.0});
  control.update(89.0);
  CHECK_FALSE(control.running());
  control.update(91.0);
  CHECK(control.running());
  CHECK_FALSE(control.stalled());
  control.set(false, true);
  control.set_state({0.0, 0.0, 20.0});
  control.update(0.0);
  control.update(91.0);
  CHECK_FALSE(control.running());
}

TEST_CASE("without ignition there is neither spark nor starter") {
  EngineControl control(small_engine());
  control.turn_key(false, true);
  control.update(200.0);
  CHECK_FALSE(control.running());
  CHECK(control.torque(0.0, 1.0) == 0.0);
}

TEST_CASE("the limiter cuts above its speed, and resumes only below its band") {
  EngineControl control(small_engine());
  const double cycles[][2] = {{499.0, 1}, {501.0, 0}, {490.0, 0}, {481.0, 0}, {479.0, 1}, {499.0, 1}};
  for (const auto& [speed, fires] : cycles) {
    control.update(speed);
    CHECK(control.load(speed, 1.0) == fires);
    CHECK(control.running());
  }
}
