// The tachometer's printed scale, compared with the needle's position.
#include <chrono>
#include <cmath>
#include <numbers>
#include <string>

#include <doctest/doctest.h>

#include "app/cabin/stage/instruments.h"
#include "app/cabin/stage/stage.h"
#include "app/vehicle/car_spec.h"
#include "tests/support/gates.h"

namespace gearshift::test {
namespace {

constexpr double kRpm = std::numbers::pi / 30.0;  // [rad/s]
constexpr double kMiddle = 336.0;                 // [px] x and y of the dial's centre in the atlas
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

// The tachometer print for this red line [rad/s], in a stage that showed a different car before.
Pictures dial_of(double red_line) {
  static cabin::Stage stage(cabin(), GEARSHIFT_ASSETS "/models");
  cabin::StageInput input;
  input.car.red_line = 123.0;
  stage.place(input);
  input.car.red_line = red_line;
  stage.place(input);
  return print_of(stage);
}

// The pixel below the needle at `rpm`; `fraction` is its distance from the dial's centre divided by the dial's radius.
const std::uint8_t* under_needle(const engine::Image& dial, double rpm, double fraction) {
  vehicle::VehicleState car;
  car.engine_speed = rpm * kRpm;
  const double angle = cabin::tach_angle(car), far = fraction * kRadius;
  const double x = kMiddle - far * std::sin(angle), y = kMiddle - far * std::cos(angle);
  return dial.pixel(static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y)));
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
Sign number_at(const engine::Image& dial, int thousands) {
  Sign sign;
  const double angle = cabin::needle_angle(1000.0 * thousands, cabin::kTachTop);
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

TEST_CASE("in every car the red part of the scale begins at the car's red line and ends at the end of the scale") {
  for (const std::string name : {"hatchback", "diesel"}) {
    CAPTURE(name);
    const double red_line = vehicle::read_car(GEARSHIFT_ASSETS "/cars/" + name + ".toml").engine.red_line;
    const Pictures dial = dial_of(red_line);
    for (const engine::Image& picture : {dial.reflects, dial.glows}) {
      for (double rpm = 20.0; rpm < 7990.0; rpm += 10.0) {
        if (std::abs(rpm - red_line / kRpm) < 25.0) continue;  // skips the antialiased edge
        CAPTURE(rpm);
        CHECK(is_red(under_needle(picture, rpm, 0.912)) == (rpm > red_line / kRpm));
      }
    }
  }
}

TEST_CASE("numbers and ticks from the red line on are red, those below are white, and none is missing") {
  for (const auto& [red_line, first_number] : {std::pair(6250.0, 7), std::pair(4750.0, 5), std::pair(4000.0, 4)}) {
    const double line = red_line;
    CAPTURE(line);
    const Pictures dial = dial_of(red_line * kRpm);
    for (const engine::Image& picture : {dial.reflects, dial.glows}) {
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

TEST_CASE("a red line beyond the scale leaves nothing red; printing the file's own red line restores the file's dial") {
  const Pictures beyond = dial_of(9000.0 * kRpm);
  for (double rpm = 20.0; rpm < 7990.0; rpm += 10.0) {
    REQUIRE_FALSE(is_red(under_needle(beyond.reflects, rpm, 0.912)));
    REQUIRE_FALSE(is_red(under_needle(beyond.glows, rpm, 0.912)));
    const bool between_ticks = std::abs(std::remainder(rpm, 250.0)) > 60.0;
    if (between_ticks) REQUIRE_FALSE(is_light(under_needle(beyond.reflects, rpm, 0.912)));
    if (between_ticks) REQUIRE_FALSE(is_light(under_needle(beyond.glows, rpm, 0.912)));
  }
  const Pictures filed = print_of(cabin::Stage(cabin(), GEARSHIFT_ASSETS "/models"));
  CHECK(is_red(under_needle(filed.reflects, 6600.0, 0.912)));  // in the model file, the dial is red from 6500 rpm
  CHECK_FALSE(is_red(under_needle(filed.reflects, 6400.0, 0.912)));
  const Pictures same = dial_of(6500.0 * kRpm), diesel = dial_of(4750.0 * kRpm);
  const auto dial = [](const engine::Image& picture) { return engine::crop(picture, 0, 0, 672, 672); };
  for (const auto& [one, other] : {std::pair(&filed.reflects, &same.reflects), std::pair(&filed.glows, &same.glows)}) {
    const double psnr = engine::difference(dial(*one), dial(*other)).psnr;
    MESSAGE("printed as before: " << psnr << " dB");
    CHECK(psnr > 35.0);
  }
  // The part of the atlas to the right of the tachometer is unchanged.
  const auto others = [](const engine::Image& picture) { return engine::crop(picture, 672, 0, 1376, 1024); };
  CHECK(engine::difference(others(filed.reflects), others(diesel.reflects), 0).worst == 0);
  CHECK(engine::difference(others(filed.glows), others(diesel.glows), 0).worst == 0);
}

TEST_CASE("a new print is reported once, when the car's red line changes; input without a car changes nothing") {
  cabin::Stage stage(cabin(), GEARSHIFT_ASSETS "/models");
  CHECK_FALSE(stage.take_dial_change());
  cabin::StageInput input;
  const auto reports_change = [&](double red_line) {
    input.car.red_line = red_line;
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
}

}  // namespace gearshift::test
