#include "app/cabin/stage/instruments.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

namespace gearshift::test {
namespace {

constexpr double kPi = std::numbers::pi;

vehicle::VehicleState running(double rpm) {
  vehicle::VehicleState car;
  car.engine_speed = rpm * kPi / 30.0;
  return car;
}

float light(cabin::Lamp lamp, const vehicle::VehicleState& car) {
  return cabin::lamp_light(lamp, car, haptics::HapticSnapshot{});
}

}  // namespace

TEST_CASE("the middle of the scale is at twelve o'clock, its ends are 135 deg to the left and right") {
  CHECK(cabin::tach_angle(running(4000.0)) == doctest::Approx(0.0));
  CHECK(cabin::tach_angle(running(0.0)) == doctest::Approx(0.75 * kPi));
  CHECK(cabin::tach_angle(running(8000.0)) == doctest::Approx(-0.75 * kPi));
  CHECK(cabin::tach_angle(running(1000.0)) - cabin::tach_angle(running(3000.0)) == doctest::Approx(67.5 * kPi / 180.0));
  vehicle::VehicleState car;
  car.road_speed = 110.0 / 3.6;
  CHECK(cabin::speed_angle(car) == doctest::Approx(0.0));
  car.road_speed = -110.0 / 3.6;
  CHECK(cabin::speed_angle(car) == doctest::Approx(0.0));
  car.top_speed = 50.0;
  car.speed_unit = vehicle::SpeedUnit::mph;
  car.road_speed = 65.0 * 0.44704;  // the scale ends at 130 mph
  CHECK(cabin::speed_angle(car) == doctest::Approx(0.0));
  vehicle::VehicleState diesel = running(3000.0);
  diesel.red_line = 4750.0 * kPi / 30.0;
  CHECK(cabin::tach_angle(diesel) == doctest::Approx(0.0));
}

TEST_CASE("a needle stays on its scale") {
  CHECK(cabin::tach_angle(running(12000.0)) == cabin::tach_angle(running(8000.0)));
  CHECK(cabin::needle_angle(-5.0, 220.0) == cabin::needle_angle(0.0, 220.0));
}

TEST_CASE("the engine's lamps are on while it is stopped with the ignition on, and off while it runs") {
  for (const cabin::Lamp lamp : {cabin::Lamp::oil, cabin::Lamp::battery, cabin::Lamp::engine}) {
    CHECK(light(lamp, running(0.0)) == 1.0f);
    CHECK(light(lamp, running(800.0)) == 0.0f);
    vehicle::VehicleState off = running(0.0);
    off.ignition = false;
    CHECK(light(lamp, off) == 0.0f);
  }
  vehicle::VehicleState dying = running(600.0);
  dying.running = false;
  CHECK(light(cabin::Lamp::engine, dying) == 1.0f);
  vehicle::VehicleState car = running(0.0);
  CHECK(light(cabin::Lamp::stall, car) == 0.0f);
  car.stalled = true;
  CHECK(light(cabin::Lamp::stall, car) == 1.0f);
  CHECK(light(cabin::Lamp::hand_brake, car) == 0.0f);
  car.pedals.hand_brake = 1.0;
  CHECK(light(cabin::Lamp::hand_brake, car) == 1.0f);
}

TEST_CASE("the engine lamp warns above the car's own red line") {
  for (const double rpm : {4800.0, 7200.0}) {  // above the red line of a diesel and of a petrol engine
    vehicle::VehicleState car = running(rpm);
    CHECK(light(cabin::Lamp::engine, car) == 0.0f);
    car.over_revved = true;
    CHECK(light(cabin::Lamp::engine, car) == 1.0f);
    car.ignition = false;
    CHECK(light(cabin::Lamp::engine, car) == 0.0f);
  }
}

TEST_CASE("the vibration is zero without shudder, and otherwise has zero mean and an amplitude equal to the shudder") {
  vehicle::VehicleState car = running(400.0);
  for (int i = 0; i < 100; ++i) CHECK(cabin::vibration(car, 0.013 * i) == 0.0);
  for (const double shudder : {0.2, 1.0, 7.0}) {
    car.shudder = shudder;
    double max = 0.0, mean = 0.0;
    for (int i = 0; i < 10000; ++i) {
      max = std::max(max, std::abs(cabin::vibration(car, 1e-3 * i)));
      mean += 1e-4 * cabin::vibration(car, 1e-3 * i);
    }
    CHECK(max <= std::min(shudder, 1.0));
    CHECK(max > 0.9 * std::min(shudder, 1.0));
    CHECK(std::abs(mean) < 1e-3);
    CHECK(cabin::vibration(car, 12.34) == cabin::vibration(car, 12.34));
  }
}

TEST_CASE("the lamp at the lever warns of over-push and saturation only") {
  haptics::HapticSnapshot lever;
  for (std::uint32_t bit = 0; bit < 6; ++bit) {
    lever.flags = 1u << bit;
    const bool warns = lever.flags == haptics::kFlagOverPush || lever.flags == haptics::kFlagSaturated;
    CHECK(cabin::lamp_light(cabin::Lamp::lever, vehicle::VehicleState{}, lever) == (warns ? 1.0f : 0.0f));
  }
}

TEST_CASE("pedals and handbrake move in proportion to their input and stop at their ends") {
  CHECK(cabin::pedal_angle(0.0) == 0.0);
  CHECK(cabin::pedal_angle(0.5) == doctest::Approx(0.5 * cabin::pedal_angle(1.0)));
  CHECK(cabin::pedal_angle(3.0) == cabin::pedal_angle(1.0));
  CHECK(cabin::pedal_angle(1.0) > 0.2);
  CHECK(cabin::hand_brake_angle(-1.0) == 0.0);
  CHECK(cabin::hand_brake_angle(2.0) == cabin::hand_brake_angle(1.0));
}

}  // namespace gearshift::test
