// The value of a bound axis is linear between the two points that the binding names.
#include "app/ui/input/axis.h"

#include <doctest/doctest.h>

#include "tests/support/turkish_letters.h"

using namespace gearshift::engine;
using namespace gearshift::test;
using namespace gearshift::ui;

TEST_CASE("a pedal is 0 at `from` and 1 at `to`, in either direction, and clamped") {
  AxisBinding pedal;
  CHECK(pedal_value(pedal, -1.0) == 0.0);
  CHECK(pedal_value(pedal, 0.5) == doctest::Approx(0.75));
  CHECK(pedal_value(pedal, 1.0) == 1.0);
  pedal.from = 0.9;  // a reversed pedal that does not reach the axis limits
  pedal.to = -0.7;
  CHECK(pedal_value(pedal, 1.0) == 0.0);
  CHECK(pedal_value(pedal, 0.5) == doctest::Approx(0.25));
  CHECK(pedal_value(pedal, -0.7) == 1.0);
  CHECK(pedal_value(pedal, -1.0) == 1.0);
}

TEST_CASE("with dead zone and end zone a value is 0 at the start, 1 before the end, and linear in between") {
  AxisBinding pedal;
  pedal.from = 0.0;
  pedal.to = 1.0;
  pedal.dead_zone = 0.1;
  pedal.end_zone = 0.2;
  CHECK(pedal_value(pedal, 0.1) == doctest::Approx(0.0));
  CHECK(pedal_value(pedal, 0.45) == doctest::Approx(0.5));
  CHECK(pedal_value(pedal, 0.8) == doctest::Approx(1.0));
  CHECK(pedal_value(pedal, 0.9) == 1.0);
  AxisBinding lever = pedal;
  lever.from = -1.0;
  CHECK(lever_value(lever, -0.45) == doctest::Approx(-0.5));
  CHECK(lever_value(lever, 0.05) == 0.0);
  CHECK(lever_value(lever, 0.8) == doctest::Approx(1.0));
}

TEST_CASE("throttle and brake as the two halves of one axis never act together") {
  AxisBinding throttle, brake;
  throttle.from = brake.from = 0.0;
  throttle.to = 1.0;
  brake.to = -1.0;
  for (const double raw : {-1.0, -0.5, 0.0, 0.25, 1.0}) {
    CHECK(pedal_value(throttle, raw) == doctest::Approx(raw > 0.0 ? raw : 0.0));
    CHECK(pedal_value(brake, raw) == doctest::Approx(raw < 0.0 ? -raw : 0.0));
  }
}

TEST_CASE("a lever is -1, 0 and 1 at its ends and rest, linear in between, with the rest off centre") {
  AxisBinding lever;
  lever.from = 0.8;
  lever.to = -1.0;
  lever.centre = 0.2;
  CHECK(lever_value(lever, 0.8) == -1.0);
  CHECK(lever_value(lever, 0.5) == doctest::Approx(-0.5));
  CHECK(lever_value(lever, 0.2) == 0.0);
  CHECK(lever_value(lever, -0.4) == doctest::Approx(0.5));
  CHECK(lever_value(lever, -1.0) == 1.0);
  CHECK(lever_value(lever, 1.0) == -1.0);
  lever.centre.reset();
  CHECK(lever_value(lever, -0.1) == doctest::Approx(0.0));
}

TEST_CASE("a stick's name matches in any case, also in a Turkish locale, because GLFW uses the user's locale") {
  const TurkishLetters turkish;
  CHECK(matches_stick({"SIDEWINDER", {}, {}, "1"}, "sidewinder"));
  CHECK(matches_stick({"Sidewinder", {}, {}, "1"}, "SIDE"));
}

TEST_CASE("a stick matches by part of its name, in any case, or by its complete GUID") {
  const PadState stick{"Thrustmaster T.16000M", {}, {}, "030000004f0400000ab1000000010000"};
  CHECK(matches_stick(stick, ""));
  CHECK(matches_stick(stick, "t.16000m"));
  CHECK(matches_stick(stick, "030000004f0400000ab1000000010000"));
  CHECK_FALSE(matches_stick(stick, "030000004f04"));
  CHECK_FALSE(matches_stick(stick, "T16000M"));
  const std::vector<PadState> two{{"Pad", {}, {}, "1"}, stick, {"Pad", {}, {}, "1"}};
  AxisBinding axis;
  CHECK(find_stick(two, axis) == &two[0]);
  axis.stick = "pad";
  axis.pad = 1;
  CHECK(find_stick(two, axis) == &two[2]);
  axis.pad = 2;
  CHECK(find_stick(two, axis) == nullptr);
}
