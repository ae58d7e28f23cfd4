// The printed scales of tachometer and speedometer, compared with the needles' positions and with the model's own font.
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>

#include <doctest/doctest.h>

#include "app/cabin/stage/instruments.h"
#include "app/cabin/stage/stage.h"
#include "app/vehicle/car_spec.h"
#include "app/vehicle/driveline.h"
#include "tests/support/gates.h"
#include "tests/support/pictures.h"

namespace gearshift::test {
namespace {

constexpr double kRpm = std::numbers::pi / 30.0;  // [rad/s]
constexpr double kMiddle = 336.0;                 // [px] x and y of the tachometer's centre in the atlas
constexpr double kSpeedMiddle = 1008.0;           // [px] x of the speedometer's centre
constexpr double kRadius = 336.0;                 // [px] the dial's radius in the atlas

cabin::StageConfig cabin() {
  cabin::StageConfig config;
  config.gate = shipped_gate("paper");
  config.hand = false;
  return config;
}

struct Pictures {
  engine::Image reflects, glows;
};

Pictures print_of(const cabin::Stage& stage) {
  const engine::Model& model = stage.model();
  for (const engine::Material& material : model.materials) {
    if (material.name != "Prints") continue;
    return {model.textures[static_cast<std::size_t>(material.base_colour_map.texture)].pixels,
            model.textures[static_cast<std::size_t>(material.emissive_map.texture)].pixels};
  }
  FAIL("no print");
  return {};
}

// The prints for this car, in a stage that showed a different car before.
Pictures dials_of(const vehicle::VehicleState& car) {
  static cabin::Stage stage(cabin(), GEARSHIFT_ASSETS "/models");
  cabin::StageInput input;
  input.car.red_line = 123.0;
  stage.place(input);
  input.car = car;
  stage.place(input);
  return print_of(stage);
}

vehicle::VehicleState car_with(double red_line, double top_speed = 50.0,
                               vehicle::SpeedUnit unit = vehicle::SpeedUnit::km_per_h) {
  vehicle::VehicleState car;
  car.red_line = red_line;
  car.top_speed = top_speed;
  car.speed_unit = unit;
  return car;
}

// The pixel below a needle at this angle; `fraction` is its distance from the dial's centre divided by the dial's radius.
const std::uint8_t* under_needle(const engine::Image& dial, double angle, double fraction, double middle = kMiddle) {
  const double far = fraction * kRadius;
  const double x = middle - far * std::sin(angle), y = kMiddle - far * std::cos(angle);
  return dial.pixel(static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y)));
}

double tach_angle_at(vehicle::VehicleState car, double rpm) {
  car.engine_speed = rpm * kRpm;
  return cabin::tach_angle(car);
}

double speed_angle_at(vehicle::VehicleState car, double speed) {  // [m/s]
  car.road_speed = speed;
  return cabin::speed_angle(car);
}

bool is_red(const std::uint8_t* p) {
  return p[0] > 100 && p[0] > 3 * p[1] && p[0] > 3 * p[2];
}

bool is_light(const std::uint8_t* p) {
  return p[0] > 100;
}

// The pixels of a printed number: how many are lit, and how many of the lit ones are red.
struct Sign {
  int lit = 0, red = 0;
};
Sign number_at(const engine::Image& dial, double angle, double middle = kMiddle) {
  Sign sign;
  const double x = middle - 0.649 * kRadius * std::sin(angle), y = kMiddle - 0.649 * kRadius * std::cos(angle);
  for (int dy = -30; dy <= 30; ++dy) {
    for (int dx = -20; dx <= 20; ++dx) {
      const std::uint8_t* p = dial.pixel(static_cast<int>(x) + dx, static_cast<int>(y) + dy);
      sign.lit += is_light(p) ? 1 : 0;
      sign.red += is_red(p) ? 1 : 0;
    }
  }
  return sign;
}

// The lit part of a picture's rectangle, scaled to a grid of 10 x 14 cells: the fraction of each cell that is lit.
using Shape = std::array<double, 140>;
Shape shape_in(const engine::Image& picture, int left, int top, int width, int height) {
  int x0 = width, x1 = -1, y0 = height, y1 = -1;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (!is_light(picture.pixel(left + x, top + y))) continue;
      x0 = std::min(x0, x), x1 = std::max(x1, x), y0 = std::min(y0, y), y1 = std::max(y1, y);
    }
  }
  Shape shape{};
  constexpr int kFine = 8;
  for (int row = 0; row < 14 * kFine; ++row) {
    for (int column = 0; column < 10 * kFine; ++column) {
      const int x = x0 + (x1 + 1 - x0) * column / (10 * kFine), y = y0 + (y1 + 1 - y0) * row / (14 * kFine);
      const auto cell = static_cast<std::size_t>(row / kFine * 10 + column / kFine);
      shape[cell] += is_light(picture.pixel(left + x, top + y)) ? 1.0 / (kFine * kFine) : 0.0;
    }
  }
  return shape;
}

// The digit 1 to 9 of the gear display, which has another font, that this shape resembles most.
int digit_like(const engine::Image& atlas, const Shape& shape) {
  int best = 0;
  double nearest = 1e9;
  for (int digit = 1; digit <= 9; ++digit) {
    const Shape printed = shape_in(atlas, 176 * (digit + 1) + 20, 672 + 45, 136, 120);
    double distance = 0.0;
    for (std::size_t i = 0; i < shape.size(); ++i) distance += std::pow(shape[i] - printed[i], 2);
    if (distance < nearest) nearest = distance, best = digit;
  }
  return best;
}

}  // namespace

TEST_CASE("in every car the red part of the scale begins at the car's red line and ends at the end of the scale") {
  for (const std::string name : {"hatchback", "diesel"}) {
    CAPTURE(name);
    const vehicle::CarSpec spec = vehicle::read_car(GEARSHIFT_ASSETS "/cars/" + name + ".toml");
    const vehicle::VehicleState car = vehicle::Driveline(spec).state();
    const double red_line = spec.engine.red_line / kRpm, top = cabin::tach_scale(car.red_line).top;
    const Pictures dial = dials_of(car);
    for (const engine::Image& picture : {dial.reflects, dial.glows}) {
      for (double rpm = 20.0; rpm < top - 10.0; rpm += 10.0) {
        if (std::abs(rpm - red_line) < 25.0) continue;  // skips the antialiased edge
        CAPTURE(rpm);
        CHECK(is_red(under_needle(picture, tach_angle_at(car, rpm), 0.912)) == (rpm > red_line));
      }
    }
  }
}

// Real tachometers of petrol cars end at 7000 or 8000, of diesels at 5000 or 6000, of trucks at 2500 or 3000;
// speedometers some 20 % beyond the top speed.
TEST_CASE("scales end a little beyond red line and top speed, at a round number, in the car's unit") {
  const auto tach = [](double rpm) { return cabin::tach_scale(rpm * kRpm); };
  CHECK(tach(6250.0) == cabin::DialScale{7000.0, 1000.0, 4});
  CHECK(tach(4750.0) == cabin::DialScale{6000.0, 1000.0, 4});
  CHECK(tach(2400.0) == cabin::DialScale{3000.0, 500.0, 4});
  CHECK(tach(12500.0) == cabin::DialScale{14000.0, 2000.0, 4});
  CHECK(tach(0.0) == cabin::DialScale{8000.0, 1000.0, 4});
  const auto speed = [](double km_per_h, vehicle::SpeedUnit unit) { return cabin::speed_scale(km_per_h / 3.6, unit); };
  CHECK(speed(180.0, vehicle::SpeedUnit::km_per_h) == cabin::DialScale{220.0, 20.0, 2});
  CHECK(speed(180.0, vehicle::SpeedUnit::mph) == cabin::DialScale{130.0, 10.0, 2});
  CHECK(speed(90.0, vehicle::SpeedUnit::km_per_h) == cabin::DialScale{110.0, 10.0, 2});
  CHECK(speed(320.0, vehicle::SpeedUnit::km_per_h) == cabin::DialScale{400.0, 50.0, 2});
  CHECK(speed(0.0, vehicle::SpeedUnit::km_per_h) == cabin::DialScale{220.0, 20.0, 2});
  for (double least = 30.0; least < 600.0; least += 7.0) {
    const cabin::DialScale scale = speed(least, vehicle::SpeedUnit::km_per_h);
    CHECK(scale.top > 1.1 * least);
    CHECK(scale.top < 1.6 * least + 10.0);
    CHECK(scale.top / scale.step < 14.0);
  }
}

TEST_CASE("numbers and ticks from the red line on are red, those below are white, and none is missing") {
  for (const auto& [red_line, first_number] : {std::pair(6250.0, 7), std::pair(4750.0, 5), std::pair(9000.0, 9)}) {
    const double line = red_line;
    CAPTURE(line);
    const vehicle::VehicleState car = car_with(red_line * kRpm);
    const int top = static_cast<int>(cabin::tach_scale(car.red_line).top / 1000.0);
    const Pictures dial = dials_of(car);
    for (const engine::Image& picture : {dial.reflects, dial.glows}) {
      for (int number = 0; number <= top; ++number) {
        CAPTURE(number);
        const double angle = tach_angle_at(car, 1000.0 * number);
        const Sign sign = number_at(picture, angle);
        CHECK(sign.lit > 100);
        CHECK(sign.red == (number >= first_number ? sign.lit : 0));
        CHECK(is_light(under_needle(picture, angle, 0.84)));
        CHECK(is_red(under_needle(picture, angle, 0.84)) == (number >= first_number));
      }
    }
  }
}

// A 1 is left out, because the other font's has a foot.
TEST_CASE("each number of the tachometer looks like this digit in another font") {
  for (const double red_line : {4750.0, 6250.0, 8100.0}) {
    const vehicle::VehicleState car = car_with(red_line * kRpm);
    const Pictures dial = dials_of(car);
    for (int number = 2; number <= static_cast<int>(cabin::tach_scale(car.red_line).top / 1000.0); ++number) {
      CAPTURE(number);
      const double angle = tach_angle_at(car, 1000.0 * number);
      const int x = static_cast<int>(kMiddle - 0.649 * kRadius * std::sin(angle));
      const int y = static_cast<int>(kMiddle - 0.649 * kRadius * std::cos(angle));
      CHECK(digit_like(dial.reflects, shape_in(dial.reflects, x - 20, y - 31, 41, 63)) == number);
    }
  }
}

TEST_CASE("the speedometer has a number and a tick wherever the needle points at a round speed in the car's unit") {
  struct Unit {
    vehicle::SpeedUnit unit;
    double mps, step, top;
  };
  for (const Unit& each : {Unit{vehicle::SpeedUnit::km_per_h, 1.0 / 3.6, 20.0, 220.0},
                           Unit{vehicle::SpeedUnit::mph, 0.44704, 10.0, 130.0}}) {
    const vehicle::VehicleState car = car_with(600.0, 50.0, each.unit);
    const Pictures dial = dials_of(car);
    for (double value = 0.0; value <= each.top; value += each.step) {
      CAPTURE(value);
      const double angle = speed_angle_at(car, each.mps * value);
      CHECK(number_at(dial.reflects, angle, kSpeedMiddle).lit > 40);
      CHECK(is_light(under_needle(dial.reflects, angle, 0.84, kSpeedMiddle)));
      CHECK(is_light(under_needle(dial.glows, angle, 0.84, kSpeedMiddle)));
      if (value == 0.0) continue;
      const double between = speed_angle_at(car, each.mps * (value - 0.25 * each.step));
      CHECK_FALSE(is_light(under_needle(dial.reflects, between, 0.84, kSpeedMiddle)));
    }
  }
  const Pictures metric = dials_of(car_with(600.0, 50.0)),
                 miles = dials_of(car_with(600.0, 50.0, vehicle::SpeedUnit::mph));
  // The unit's name, below the middle.
  CHECK(engine::difference(crop(metric.reflects, 908, 436, 200, 40), crop(miles.reflects, 908, 436, 200, 40)).worst >
        100);
}

TEST_CASE("a print changes the two dials and nothing beside them") {
  const Pictures filed = print_of(cabin::Stage(cabin(), GEARSHIFT_ASSETS "/models"));
  const Pictures diesel = dials_of(car_with(4750.0 * kRpm));
  const auto others = [](const engine::Image& picture) { return crop(picture, 1344, 0, 704, 1024); };
  const auto below = [](const engine::Image& picture) { return crop(picture, 0, 672, 1344, 352); };
  for (const auto& [one, other] :
       {std::pair(&filed.reflects, &diesel.reflects), std::pair(&filed.glows, &diesel.glows)}) {
    CHECK(engine::difference(others(*one), others(*other), 0).worst == 0);
    CHECK(engine::difference(below(*one), below(*other), 0).worst == 0);
    // The face between hub and numbers, and the rim: as in the model's file.
    const auto face = [](const engine::Image& picture) { return crop(picture, 300, 180, 72, 72); };
    const auto rim = [](const engine::Image& picture) { return crop(picture, 0, 280, 16, 100); };
    CHECK(engine::difference(face(*one), face(*other), 0).worst <= 1);
    CHECK(engine::difference(rim(*one), rim(*other), 0).worst == 0);
  }
  // For looking at: GEARSHIFT_WRITE_DIALS=FILE.png writes the atlas with a car in mph.
  if (const char* file = std::getenv("GEARSHIFT_WRITE_DIALS"))
    engine::write_png(file, dials_of(car_with(6250.0 * kRpm, 50.0, vehicle::SpeedUnit::mph)).reflects);
}

TEST_CASE("a new print is reported once, when the car's dials change; input without a car changes nothing") {
  cabin::Stage stage(cabin(), GEARSHIFT_ASSETS "/models");
  CHECK_FALSE(stage.take_dial_change());
  cabin::StageInput input;
  const auto reports_change = [&](double red_line, double top_speed = 50.0,
                                  vehicle::SpeedUnit unit = vehicle::SpeedUnit::km_per_h) {
    input.car = car_with(red_line, top_speed, unit);
    stage.place(input);
    stage.place(input);
    return stage.take_dial_change();
  };
  const auto begin = std::chrono::steady_clock::now();
  CHECK(reports_change(500.0));
  const std::chrono::duration<double> cost = std::chrono::steady_clock::now() - begin;
  MESSAGE("printed, and two frames placed, in " << 1e3 * cost.count() << " ms");
  CHECK_FALSE(stage.take_dial_change());
  CHECK_FALSE(reports_change(500.0));
  CHECK_FALSE(reports_change(0.0));
  CHECK_FALSE(reports_change(500.0));
  CHECK(reports_change(600.0));
  CHECK(reports_change(600.0, 80.0));
  CHECK(reports_change(600.0, 80.0, vehicle::SpeedUnit::mph));
  CHECK_FALSE(reports_change(600.0, 80.0, vehicle::SpeedUnit::mph));
}

}  // namespace gearshift::test
