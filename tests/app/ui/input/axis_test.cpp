// The value of a bound axis is linear between the two points that the binding names.
#include "app/ui/input/axis.h"

#include <doctest/doctest.h>

#include "app/ui/input/bound_controllers.h"
#include "tests/support/controllers.h"
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
  CHECK(matches_stick(controller("SIDEWINDER", {}), "sidewinder"));
  CHECK(matches_stick(controller("Sidewinder", {}), "SIDE"));
}

TEST_CASE("a controller is named by part of its name in any case, its USB id or its GUID") {
  Controller stick = controller("Thrustmaster T.16000M", {}, 0, "044f:b10a");
  stick.guid = "030000004f0400000ab1000000010000";
  CHECK_FALSE(matches_stick(stick, ""));
  CHECK(matches_stick(stick, "t.16000m"));
  CHECK(matches_stick(stick, "044f:b10a"));
  CHECK(matches_stick(stick, "030000004f0400000ab1000000010000"));
  CHECK_FALSE(matches_stick(stick, "030000004f04"));
  CHECK_FALSE(matches_stick(stick, "T16000M"));
}

// Many boards share an id: Arduino's Leonardo has 2341:8036 in shifters, pedals and handbrakes alike.
TEST_CASE("a controller with another name today is found by its USB id, if nothing else may be meant") {
  const Controller brake = controller("My brake", {0.1f}, 0, "2341:8036");
  Controller renamed = brake, shifter = brake;
  renamed.name = "Arduino Leonardo";
  shifter.name = "Shifter";
  const ControllerName name{"My brake", "2341:8036"};
  Bindings bindings;
  const auto found = [&](const std::vector<Controller>& all) {
    const Controller* one = find_controller(bindings, name, 0, all);
    return one == nullptr ? std::string() : one->name;
  };
  CHECK(found({renamed}) == "Arduino Leonardo");
  CHECK(found({renamed, brake}) == "My brake");  // the name counts
  CHECK(found({renamed, shifter}).empty());      // which of them is not known
  bindings.controllers = {{{"Shifter", "2341:8036"}, 0, {}, {{1, {0}}}}};
  CHECK(found({shifter}).empty());  // the shifter is named itself
  CHECK(found({renamed, shifter}) == "Arduino Leonardo");
  renamed.id = "0000:0000";
  CHECK(find_controller({}, {"My brake", "0000:0000"}, 0, {renamed}) == nullptr);
}

TEST_CASE("a name that is exactly a controller's does not reach another one whose name contains it") {
  const Controller box = controller("Button Box", {0.0f}), second = controller("Button Box 2", {0.0f});
  Bindings bindings;
  bindings.controllers = {{{"Button Box", ""}, 0, {{Action::quit, {0}}}, {}},
                          {{"Button Box 2", ""}, 0, {}, {{1, {0}}}}};
  const std::vector<Controller> both{second, box}, only_second{second};
  CHECK(find_controllers(bindings, {"Button Box", ""}, both) == std::vector<const Controller*>{&both[1]});
  CHECK(find_controllers(bindings, {"Button Box", ""}, only_second).empty());
  CHECK(find_controllers({}, {"button box", ""}, both).size() == 2);
}

TEST_CASE("an axis belongs to the n-th controller of its name, or to any game pad that the bindings do not name") {
  const std::vector<Controller> all{controller("Pedals", {0.1f, 0.2f}), gamepad({0.3f, 0.4f}),
                                    controller("Pedals", {0.5f}, 3, "a")};
  Bindings bindings;
  const auto raw = [&](const AxisBinding& axis) {
    const std::optional<double> value = raw_value(bindings, axis, all);
    return value ? std::optional(static_cast<float>(*value)) : std::nullopt;
  };
  CHECK(raw({.of = {"pedals", ""}, .axis = 1}) == 0.2f);
  CHECK(raw({.of = {"pedals", ""}, .which = 1}) == 0.5f);
  CHECK_FALSE(raw({.of = {"pedals", ""}, .which = 1, .axis = 1}));
  CHECK_FALSE(raw({.of = {"pedals", ""}, .which = 2}));
  CHECK(raw({.axis = 1}) == 0.4f);
  bindings.controllers = {{{"a pad", ""}, 0, {}, {}}};
  CHECK_FALSE(raw({.axis = 1}));
}

TEST_CASE("an encoder board that GLFW takes for a pad moves nothing until it is set up") {
  Controller encoder = gamepad({1.0f, 1.0f});
  encoder.id = "0079:0006";
  const std::vector<Controller> all{encoder, gamepad({0.3f, 0.4f})};
  Bindings bindings;
  CHECK(free_gamepads(bindings, all) == std::vector{&all[1]});
  CHECK(unbound_controllers(bindings, all) == std::vector{&all[0]});
  CHECK(raw_value(bindings, {.axis = 1}, all) == doctest::Approx(0.4f));
}
