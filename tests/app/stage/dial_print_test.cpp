// The tachometer's print, against the needle that points at it.
#include <chrono>
#include <cmath>
#include <numbers>
#include <string>

#include <doctest/doctest.h>

#include "app/stage/instruments.h"
#include "app/stage/stage.h"
#include "app/vehicle/car_spec.h"
#include "tests/support/gates.h"

namespace gearshift {
namespace {

constexpr double kRpm = std::numbers::pi / 30.0;  // [rad/s]
constexpr double kMiddle = 336.0;                 // [px] of the dial on the atlas, both ways
constexpr double kRadius = 336.0;                 // [px] of the dial's field

StageConfig cabin() {
  StageConfig config;
  config.gate = shipped_gate("paper");
  config.hand = false;
  return config;
}

struct Pictures {
  Image reflects, glows;
};

Pictures print_of(const Stage& stage) {
  const Model& model = stage.model();
  for (const Material& material : model.materials) {
    if (material.name != "Prints") continue;
    return {model.textures[static_cast<std::size_t>(material.base_colour_map.texture)].pixels,
            model.textures[static_cast<std::size_t>(material.emissive_map.texture)].pixels};
  }
  FAIL("no print");
  return {};
}

// In a cabin that had another car before.
Pictures dial_of(double red_line) {
  static Stage stage(cabin(), GEARSHIFT_ASSETS "/models");
  StageInput input;
  input.car.red_line = 123.0;
  stage.place(input);
  input.car.red_line = red_line;
  stage.place(input);
  return print_of(stage);
}

// What the tip of a needle covers that shows so many [1/min], at a share of the dial's radius.
const std::uint8_t* under_needle(const Image& dial, double rpm, double share) {
  VehicleState car;
  car.engine_speed = rpm * kRpm;
  const double angle = tach_angle(car), far = share * kRadius;
  const double x = kMiddle - far * std::sin(angle), y = kMiddle - far * std::cos(angle);
  return dial.pixel(static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y)));
}

bool is_red(const std::uint8_t* p) {
  return p[0] > 100 && p[0] > 3 * p[1] && p[0] > 3 * p[2];
}

bool is_light(const std::uint8_t* p) {
  return p[0] > 100;
}

// Of a number's field: is any of it lit, and is what is lit red?
struct Sign {
  int lit = 0, red = 0;
};
Sign number_at(const Image& dial, int thousands) {
  Sign sign;
  const double angle = needle_angle(1000.0 * thousands, kTachTop);
  const double x = kMiddle - 0.649 * kRadius * std::sin(angle), y = kMiddle - 0.649 * kRadius * std::cos(angle);
  for (int dy = -20; dy <= 20; ++dy) {
    for (int dx = -16; dx <= 16; ++dx) {
      const std::uint8_t* p = dial.pixel(static_cast<int>(x) + dx, static_cast<int>(y) + dy);
      sign.lit += is_light(p) ? 1 : 0;
      sign.red += is_red(p) ? 1 : 0;
    }
  }
  return sign;
}

}  // namespace

TEST_CASE(
    "the needle enters the red where its car's red line is, in every car, and leaves it at the end of the scale") {
  for (const std::string name : {"hatchback", "diesel"}) {
    CAPTURE(name);
    const double red_line = read_car(GEARSHIFT_ASSETS "/cars/" + name + ".toml").engine.red_line;
    const Pictures dial = dial_of(red_line);
    for (const Image& picture : {dial.reflects, dial.glows}) {
      for (double rpm = 20.0; rpm < 7990.0; rpm += 10.0) {
        if (std::abs(rpm - red_line / kRpm) < 25.0) continue;  // half a pixel, and the edge's softness
        CAPTURE(rpm);
        CHECK(is_red(under_needle(picture, rpm, 0.912)) == (rpm > red_line / kRpm));
      }
    }
  }
}

TEST_CASE("numbers and ticks from the red line on are red, those below white, and none is lost") {
  for (const auto& [red_line, first_number] : {std::pair(6250.0, 7), std::pair(4750.0, 5), std::pair(4000.0, 4)}) {
    const double line = red_line;
    CAPTURE(line);
    const Pictures dial = dial_of(red_line * kRpm);
    for (const Image& picture : {dial.reflects, dial.glows}) {
      for (int number = 0; number <= 8; ++number) {
        CAPTURE(number);
        const Sign sign = number_at(picture, number);
        CHECK(sign.lit > 100);
        CHECK(sign.red == (number >= first_number ? sign.lit : 0));
      }
      for (double rpm = 0.0; rpm <= 8000.0; rpm += 1000.0) {
        CAPTURE(rpm);
        CHECK(is_light(under_needle(picture, rpm, 0.84)));
        CHECK(is_red(under_needle(picture, rpm, 0.84)) == (rpm >= red_line));
      }
    }
  }
}

TEST_CASE("a red line beyond the scale leaves nothing red; that of the file, printed anew, looks as it did") {
  const Pictures beyond = dial_of(9000.0 * kRpm);
  for (double rpm = 20.0; rpm < 7990.0; rpm += 10.0) {
    REQUIRE_FALSE(is_red(under_needle(beyond.reflects, rpm, 0.912)));
    REQUIRE_FALSE(is_red(under_needle(beyond.glows, rpm, 0.912)));
    const bool between_ticks = std::abs(std::remainder(rpm, 250.0)) > 60.0;
    if (between_ticks) REQUIRE_FALSE(is_light(under_needle(beyond.reflects, rpm, 0.912)));
    if (between_ticks) REQUIRE_FALSE(is_light(under_needle(beyond.glows, rpm, 0.912)));
  }
  const Pictures filed = print_of(Stage(cabin(), GEARSHIFT_ASSETS "/models"));
  CHECK(is_red(under_needle(filed.reflects, 6600.0, 0.912)));  // assets/models/README.md: red from 6500
  CHECK_FALSE(is_red(under_needle(filed.reflects, 6400.0, 0.912)));
  const Pictures same = dial_of(6500.0 * kRpm), diesel = dial_of(4750.0 * kRpm);
  const auto dial = [](const Image& picture) { return crop(picture, 0, 0, 672, 672); };
  for (const auto& [one, other] : {std::pair(&filed.reflects, &same.reflects), std::pair(&filed.glows, &same.glows)}) {
    const double psnr = difference(dial(*one), dial(*other)).psnr;
    MESSAGE("printed as it was: " << psnr << " dB");
    CHECK(psnr > 35.0);
  }
  // What is no tachometer is not touched.
  const auto others = [](const Image& picture) { return crop(picture, 672, 0, 1376, 1024); };
  CHECK(difference(others(filed.reflects), others(diesel.reflects), 0).worst == 0);
  CHECK(difference(others(filed.glows), others(diesel.glows), 0).worst == 0);
}

TEST_CASE("a new print is told once, when the car's red line is another; a place without a car changes nothing") {
  Stage stage(cabin(), GEARSHIFT_ASSETS "/models");
  CHECK_FALSE(stage.take_new_print());
  StageInput input;
  const auto told = [&](double red_line) {
    input.car.red_line = red_line;
    stage.place(input);
    stage.place(input);
    return stage.take_new_print();
  };
  const auto begin = std::chrono::steady_clock::now();
  CHECK(told(500.0));
  const std::chrono::duration<double> cost = std::chrono::steady_clock::now() - begin;
  MESSAGE("printed, and two frames placed, in " << 1e3 * cost.count() << " ms");
  CHECK_FALSE(stage.take_new_print());
  CHECK_FALSE(told(500.0));
  CHECK_FALSE(told(0.0));
  CHECK_FALSE(told(500.0));
  CHECK(told(600.0));
}

}  // namespace gearshift
