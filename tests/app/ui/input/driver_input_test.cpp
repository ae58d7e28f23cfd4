// The input for the driver's hand and feet, frame by frame, without a window.
#include "app/ui/input/driver_input.h"

#include <cmath>
#include <limits>
#include <random>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "app/vehicle/car_load.h"
#include "tests/support/controllers.h"
#include "tests/support/gates.h"

using namespace gearshift::engine;
using namespace gearshift::haptics;
using namespace gearshift::test;
using namespace gearshift::ui;

namespace {

constexpr double kFrame = 0.01;  // [s]

Bindings bindings() {
  Bindings b;
  b.keys = {{Action::lever_left, {GLFW_KEY_LEFT}},  {Action::lever_right, {GLFW_KEY_RIGHT}},
            {Action::lever_forward, {GLFW_KEY_UP}}, {Action::lever_back, {GLFW_KEY_DOWN}},
            {Action::push_down, {GLFW_KEY_X}},      {Action::lift, {GLFW_KEY_Y}},
            {Action::throttle, {GLFW_KEY_D}},       {Action::clutch, {GLFW_KEY_A}},
            {Action::throttle_light, {GLFW_KEY_F}}, {Action::clutch_hold, {GLFW_KEY_Q}},
            {Action::starter, {GLFW_KEY_E}},        {Action::hand_brake, {GLFW_KEY_H}},
            {Action::ignition, {GLFW_KEY_I}},       {Action::stop, {GLFW_KEY_SPACE, GLFW_KEY_F12}},
            {Action::recentre, {GLFW_KEY_R}},       {Action::grab_mouse, {GLFW_KEY_ESCAPE}},
            {Action::full_screen, {GLFW_KEY_F11}}};
  b.pad_buttons = {{Action::lift, {2}}, {Action::arm, {5}}};
  b.lever_select = AxisBinding{.axis = 0, .dead_zone = 0.2};
  b.lever_shift = AxisBinding{.axis = 1, .from = 1.0, .to = -1.0, .dead_zone = 0.2};
  b.throttle = AxisBinding{.axis = 2};
  b.lever.mode = LeverMode::places;
  return b;
}

struct Driver {
  DriverInput driver{{bindings(), {0.06, 0.05}}};
  gearshift::vehicle::KeyboardPedals feet{{}, {.bite = 0.8, .closed = 0.2}};
  gearshift::haptics::Pedals pedals;
  WindowInput input;

  void key(int code, bool down) { input.events.emplace_back(KeyEvent{code, down, false, false, false}); }
  void frame(double seconds = kFrame, bool ui_has_mouse = false, bool ui_has_keys = false) {
    driver.update(input, seconds, ui_has_mouse, ui_has_keys);
    pedals = feet.move(driver.pedal_keys(), seconds, 0.0, false);
    input.events.clear();
    input.mouse_moved = glm::dvec2(0.0);
  }
  void click() {
    input.mouse_down[0] = true;
    frame();
    input.mouse_down[0] = false;
    frame();
  }
  glm::dvec2 at() const { return driver.hand().position; }
};

bool near(glm::dvec2 a, glm::dvec2 b) {
  return std::abs(a.x - b.x) < 1e-12 && std::abs(a.y - b.y) < 1e-12;
}

}  // namespace

TEST_CASE("after a click the mouse moves the hand: right is right, up is forward, 0.12 mm per pixel") {
  Driver d;
  d.input.mouse_moved = {100.0, 50.0};
  d.frame();
  CHECK(near(d.at(), {0.0, 0.0}));  // no click yet
  d.click();
  CHECK(d.driver.mouse_moves_lever());
  d.input.mouse_moved = {100.0, -50.0};
  d.frame();
  CHECK(near(d.at(), {0.012, 0.006}));
  d.frame();
  CHECK(near(d.at(), {0.012, 0.006}));  // without mouse movement the hand stays
}

TEST_CASE("a click on the panel does not grab the mouse; the grab key grabs and releases it, also over the panel") {
  Driver d;
  d.input.mouse_down[0] = true;
  d.frame(kFrame, true);
  d.frame();  // the mouse leaves the panel with the button pressed; this is no click on the cabin
  CHECK_FALSE(d.driver.mouse_moves_lever());
  d.key(GLFW_KEY_ESCAPE, true);
  d.frame(kFrame, false, true);
  CHECK_FALSE(d.driver.mouse_moves_lever());  // the panel has the keyboard focus, so the key went to the panel
  d.key(GLFW_KEY_ESCAPE, false);
  d.key(GLFW_KEY_ESCAPE, true);
  d.frame();
  CHECK(d.driver.mouse_moves_lever());
  d.key(GLFW_KEY_ESCAPE, false);
  d.key(GLFW_KEY_ESCAPE, true);
  d.frame(kFrame, true, true);
  CHECK_FALSE(d.driver.mouse_moves_lever());
}

TEST_CASE("mouse movement before the click does not move the hand") {
  Driver d;
  d.input.mouse_moved = {-300.0, -100.0};
  d.input.mouse_down[0] = true;
  d.frame();
  CHECK(d.driver.mouse_moves_lever());
  CHECK(near(d.at(), {0.0, 0.0}));
  d.input.mouse_moved = {100.0, 0.0};
  d.frame();
  CHECK(near(d.at(), {0.012, 0.0}));
}

TEST_CASE("lever keys move the hand at their speed, independent of the frame rate") {
  Driver slow, fast;
  for (Driver* d : {&slow, &fast}) {
    d->key(GLFW_KEY_RIGHT, true);
    d->key(GLFW_KEY_UP, true);
  }
  for (int i = 0; i < 10; ++i) slow.frame(0.01);
  for (int i = 0; i < 100; ++i) fast.frame(0.001);
  CHECK(near(slow.at(), {0.025, 0.025}));
  CHECK(near(fast.at(), {0.025, 0.025}));
  slow.key(GLFW_KEY_RIGHT, false);
  slow.key(GLFW_KEY_DOWN, true);  // the up key is still pressed, so both keys cancel out
  slow.frame(0.001);              // the right key was just released and still counts in this frame
  const glm::dvec2 stays = slow.at();
  slow.driver.feel(stays);
  slow.frame(0.5);
  CHECK(near(slow.at(), stays));
}

TEST_CASE("the hand stays within reach for any input") {
  Driver d;
  d.click();
  std::mt19937 chance(4);
  std::uniform_real_distribution<double> any(-1000.0, 1000.0);
  for (int i = 0; i < 1000; ++i) {
    d.input.mouse_moved = {any(chance), any(chance)};
    if (i % 100 == 0) d.input.mouse_moved.x = std::numeric_limits<double>::quiet_NaN();
    d.frame();
    CHECK(std::abs(d.at().x) <= 0.06);
    CHECK(std::abs(d.at().y) <= 0.05);
  }
  d.driver.recentre({1.0, -0.01});
  CHECK(near(d.at(), {0.06, -0.01}));
  d.driver.recentre({0.01, 0.02});
  CHECK(near(d.at(), {0.01, 0.02}));
  DeviceSpec small;
  small.workspace = {0.005, 0.03};
  d.driver.set_gate(paper_gate(), small);
  CHECK(near(d.at(), {0.005, 0.02}));
}

TEST_CASE("a mouse beyond the reach pushes, up to 75 N at 50 mm, and stops pushing when it returns") {
  Driver d;
  d.click();
  d.input.mouse_moved = {0.0, -(0.05 + 0.025) / 0.12e-3};  // 25 mm beyond the reach of 50 mm: half of the full push
  d.frame();
  CHECK(near(d.at(), {0.0, 0.05}));
  CHECK(d.driver.hand().push.y == doctest::Approx(37.5));
  CHECK(d.driver.hand().push.x == 0.0);
  d.input.mouse_moved = {0.0, -100'000.0};
  d.frame();
  CHECK(d.driver.hand().push.y == doctest::Approx(75.0));
  d.input.mouse_moved = {0.0, 0.05 / 0.12e-3};
  d.frame();
  CHECK(d.driver.hand().push.y == doctest::Approx(0.0).scale(1.0));
  CHECK(d.at().y == doctest::Approx(0.05));
  // Keys never push: a key that is held for long only moves the hand to the limit of its reach.
  d.key(GLFW_KEY_UP, true);
  d.frame(10.0);
  CHECK(d.driver.hand().push.y == doctest::Approx(0.0).scale(1.0));
  d.input.mouse_moved = {0.0, -100'000.0};
  d.driver.recentre({0.0, 0.0});
  CHECK(d.driver.hand().push == glm::dvec2(0.0));
}

TEST_CASE("the reach in every shipped gate extends beyond its gears and not beyond the device") {
  DeviceSpec device;
  device.workspace = kPaperWorkspace;
  for (const std::string& name : shipped_names()) {
    CAPTURE(name);
    const Gate gate = shipped_gate(name);
    const glm::dvec2 reach = hand_reach(gate, device);
    CHECK(reach.x <= kPaperWorkspace.x);
    CHECK(reach.y <= kPaperWorkspace.y);
    for (const Slot& slot : slots(gate)) {
      const glm::dvec2 rest = rest_position(gate, slot.gear);
      CHECK(std::abs(rest.x) + 0.01 < reach.x);
      CHECK(std::abs(rest.y) + 0.015 < reach.y);
    }
  }
  CHECK(near(hand_reach(paper_gate(), device), {0.055, 0.060}));
}

TEST_CASE("knob and ring are held while their key or button is pressed") {
  Driver d;
  d.key(GLFW_KEY_X, true);
  d.input.controllers = {gamepad({}, {0, 0, 1})};
  d.frame();
  CHECK(d.driver.hand().pressed_down);
  CHECK(d.driver.hand().lifted);
  d.key(GLFW_KEY_X, false);
  d.input.controllers = {gamepad({}, {0, 0, 0})};
  d.frame();
  d.frame();
  CHECK_FALSE(d.driver.hand().pressed_down);
  CHECK_FALSE(d.driver.hand().lifted);
}

TEST_CASE("a key pressed and released between two frames counts for one frame, and acts once") {
  Driver d;
  d.key(GLFW_KEY_RIGHT, true);
  d.key(GLFW_KEY_RIGHT, false);
  d.key(GLFW_KEY_R, true);
  d.key(GLFW_KEY_R, false);
  d.frame();
  CHECK(near(d.at(), {0.0025, 0.0}));
  CHECK(d.driver.pressed() == std::vector{Action::recentre});
  d.frame();
  CHECK(near(d.at(), {0.0025, 0.0}));
  CHECK(d.driver.pressed().empty());
}

TEST_CASE("one-shot actions are listed in order, once per press; held actions are never listed") {
  Driver d;
  d.input.controllers = {gamepad({})};
  d.frame();
  d.key(GLFW_KEY_F11, true);
  d.key(GLFW_KEY_D, true);
  d.key(GLFW_KEY_SPACE, true);
  d.input.controllers = {gamepad({}, {0, 0, 0, 0, 0, 1})};
  d.frame();
  CHECK(d.driver.pressed() == std::vector{Action::full_screen, Action::stop, Action::arm});
  d.key(GLFW_KEY_F11, true);  // the operating system repeats the held key
  d.frame();
  CHECK(d.driver.pressed().empty());
}

TEST_CASE("a pressed or released pedal key moves the pedal over its full travel in the configured time") {
  Driver d;
  d.key(GLFW_KEY_D, true);
  for (int i = 0; i < 10; ++i) d.frame();
  CHECK(d.pedals.throttle == doctest::Approx(0.1 / 0.25));
  for (int i = 0; i < 20; ++i) d.frame();
  CHECK(d.pedals.throttle == 1.0);
  d.key(GLFW_KEY_D, false);
  for (int i = 0; i < 10; ++i) d.frame();
  CHECK(d.pedals.throttle == doctest::Approx(1.0 - 0.1 / 0.25));
  for (int i = 0; i < 20; ++i) d.frame();
  CHECK(d.pedals.throttle == 0.0);
}

TEST_CASE("a released keyboard clutch moves slowly around the bite point, for the configured time, at any frame rate") {
  for (const int parts : {1, 7}) {  // number of updates into which 10 ms are divided
    Driver d;
    const auto hold = [&d, parts](int key, double seconds) {
      d.key(key, true);
      for (int i = 0; i < std::lround(100.0 * parts * seconds); ++i) d.frame(0.01 / parts);
    };
    hold(GLFW_KEY_A, 0.3);
    CHECK(d.pedals.clutch == 1.0);
    d.key(GLFW_KEY_A, false);
    double slips = 0.0;
    for (int i = 0; i < 450 * parts; ++i) {
      d.frame(0.01 / parts);
      const double pedal = d.pedals.clutch;
      if (pedal < 0.8 - 1e-9 && pedal > 0.2 + 1e-9) slips += 0.01 / parts;
    }
    CHECK(slips == doctest::Approx(gearshift::vehicle::PedalTiming{}.slip_time).epsilon(0.02));
    CHECK(d.pedals.clutch == 0.0);
  }
}

TEST_CASE("the clutch stays at the bite point while its hold key is pressed, and continues when it is released") {
  Driver d;
  d.key(GLFW_KEY_A, true);
  for (int i = 0; i < 30; ++i) d.frame();
  d.key(GLFW_KEY_A, false);
  for (int i = 0; i < 60; ++i) d.frame();
  d.key(GLFW_KEY_Q, true);
  d.frame();
  const double bite = d.pedals.clutch;
  CHECK((bite > 0.5 && bite < 0.75));
  for (int i = 0; i < 300; ++i) d.frame();
  CHECK(d.pedals.clutch == bite);
  d.key(GLFW_KEY_Q, false);
  for (int i = 0; i < 450; ++i) d.frame();
  CHECK(d.pedals.clutch == 0.0);
}

TEST_CASE("light throttle is 0.2 of full throttle; the key for full throttle takes precedence") {
  Driver d;
  d.key(GLFW_KEY_F, true);
  for (int i = 0; i < 30; ++i) d.frame();
  CHECK(d.pedals.throttle == 0.2);
  d.key(GLFW_KEY_D, true);
  for (int i = 0; i < 30; ++i) d.frame();
  CHECK(d.pedals.throttle == 1.0);
  d.key(GLFW_KEY_D, false);
  for (int i = 0; i < 30; ++i) d.frame();
  CHECK(d.pedals.throttle == 0.2);
}

TEST_CASE("the ignition is on at the start; ignition and handbrake toggle with each press, the starter must be held") {
  Driver d;
  d.frame();
  CHECK(d.driver.controls().ignition);
  CHECK(d.driver.controls().pedals.hand_brake == 0.0);
  for (const int key : {GLFW_KEY_I, GLFW_KEY_H, GLFW_KEY_E}) d.key(key, true);
  d.frame();
  CHECK_FALSE(d.driver.controls().ignition);
  CHECK(d.driver.controls().pedals.hand_brake == 1.0);
  CHECK(d.driver.controls().starter);
  for (const int key : {GLFW_KEY_I, GLFW_KEY_H, GLFW_KEY_E}) d.key(key, false);
  for (const int key : {GLFW_KEY_I, GLFW_KEY_H}) d.key(key, true);
  d.frame();
  d.frame();
  CHECK(d.driver.controls().ignition);
  CHECK(d.driver.controls().pedals.hand_brake == 0.0);
  CHECK_FALSE(d.driver.controls().starter);
}

TEST_CASE("a pedal's axis is used from its first movement on, because a pad reports 0 for an untouched trigger") {
  Driver d;
  d.input.controllers = {gamepad({0.0f, 0.0f, 0.0f})};  // if this pad were used, axis 2 at 0 would be half throttle
  d.frame();
  CHECK(d.driver.controls().pedals.throttle == 0.0);
  d.input.controllers[0].gamepad->axes[2] = -1.0f;
  d.frame();
  CHECK(d.driver.controls().pedals.throttle == 0.0);
  d.input.controllers[0].gamepad->axes[2] = 0.0f;
  d.frame();
  CHECK(d.driver.controls().pedals.throttle == doctest::Approx(0.5));
  d.input.controllers.clear();  // the pad is unplugged
  d.frame();
  CHECK(d.driver.controls().pedals.throttle == 0.0);
}

// A Logitech G29 that nobody touches (new-lg4ff issue 91): until its first report the kernel holds 0, which is fully
// pressed for its pedals and half for its wheel; then the pedals rest at 1. Axes: wheel, clutch, throttle, brake.
TEST_CASE("a wheel that nobody has set up moves neither pedals nor lever, with the shipped bindings") {
  Driver d;
  d.driver = DriverInput({read_bindings(GEARSHIFT_ASSETS "/bindings/default.toml"), {0.06, 0.05}});
  const auto all_at_rest = [&] {
    const auto& pedals = d.driver.controls().pedals;
    return pedals.throttle == 0.0 && pedals.brake == 0.0 && pedals.clutch == 0.0 && pedals.hand_brake == 0.0 &&
           glm::length(d.driver.hand().position) == 0.0 && d.driver.pressed().empty();
  };
  d.input.controllers = {controller("Logitech G29 Driving Force Racing Wheel", {0.0f, -1.0f, -1.0f, -1.0f}, 29)};
  d.frame();
  CHECK(all_at_rest());
  Controller& wheel = d.input.controllers[0];
  for (const float turned : {0.0f, -0.5f, 0.5f, 0.0f}) {
    wheel.axes = {turned, 1.0f, turned, -turned};
    std::fill(wheel.buttons.begin(), wheel.buttons.end(), turned > 0.0f ? 1 : 0);
    d.frame();
    CHECK(all_at_rest());
  }
  // Negative control: a game pad with the same values.
  wheel.gamepad.emplace();
  wheel.gamepad->axes = {0.0f, 0.0f, 0.0f, 0.0f, -1.0f, -1.0f};
  d.frame();
  wheel.gamepad->axes[5] = 1.0f;
  d.frame();
  CHECK(d.driver.controls().pedals.throttle == 1.0);
}

TEST_CASE("the first report of a wheel that is set up is no motion: its pedals stay up until a foot moves them") {
  Driver d;
  Bindings custom = bindings();
  custom.throttle = AxisBinding{.of = {"G29", ""}, .axis = 2, .from = 1.0, .to = -1.0};
  d.driver = DriverInput({custom, {0.06, 0.05}});
  d.input.controllers = {controller("Logitech G29 Driving Force Racing Wheel", {0.0f, -1.0f, -1.0f, -1.0f})};
  std::vector<float>& axes = d.input.controllers[0].axes;
  d.frame();
  CHECK(d.driver.controls().pedals.throttle == 0.0);
  for (const float rest : {0.4f, 0.4f}) {  // the first report, of a pedal that springs back to less than its end
    axes[2] = rest;
    d.frame();
    CHECK(d.driver.controls().pedals.throttle == 0.0);
  }
  axes[2] = 0.0f;
  d.frame();
  CHECK(d.driver.controls().pedals.throttle == doctest::Approx(0.5));
}

TEST_CASE("each pedal follows its own axis only") {
  Bindings custom = bindings();
  custom.throttle = AxisBinding{.axis = 0};
  custom.brake = AxisBinding{.axis = 1};
  custom.clutch = AxisBinding{.axis = 2};
  custom.lever_select.reset();
  custom.lever_shift.reset();
  for (const std::size_t axis : {0u, 1u, 2u}) {
    CAPTURE(axis);
    DriverInput driver({custom, {0.06, 0.05}});
    WindowInput input;
    input.controllers = {gamepad({-1.0f, -1.0f, -1.0f})};
    driver.update(input, kFrame, false, false);
    input.controllers[0].gamepad->axes[axis] = 0.5f;  // three quarters of the pedal's travel
    driver.update(input, kFrame, false, false);
    const double pedals[] = {driver.controls().pedals.throttle, driver.controls().pedals.brake,
                             driver.controls().pedals.clutch};
    for (const std::size_t pedal : {0u, 1u, 2u}) CHECK(pedals[pedal] == (pedal == axis ? 0.75 : 0.0));
  }
}

TEST_CASE("the brake key presses the brake and not the throttle") {
  Bindings custom = bindings();
  custom.keys[Action::brake] = {GLFW_KEY_S};
  DriverInput driver({custom, {0.06, 0.05}});
  WindowInput input;
  input.events = {KeyEvent{GLFW_KEY_S, true, false, false, false}};
  driver.update(input, 0.1, false, false);
  CHECK(driver.pedal_keys().brake);
  CHECK_FALSE(driver.pedal_keys().throttle);
}

TEST_CASE("a hand moved to a lever beyond its reach stops at the limit and does not push") {
  for (const glm::dvec2 lever : {glm::dvec2(0.08, 0.0), {-0.08, 0.0}, {0.0, 0.07}, {0.0, -0.07}}) {
    CAPTURE(lever.x);
    Driver d;
    d.click();
    d.driver.recentre(lever);
    CHECK(d.driver.hand().push == glm::dvec2(0.0));
    d.frame();
    CHECK(d.driver.hand().push == glm::dvec2(0.0));
    const glm::dvec2 before = d.at();
    const glm::dvec2 back = -0.01 * lever / glm::length(lever);  // [m] 10 mm towards the middle
    d.input.mouse_moved = glm::dvec2{back.x, -back.y} / 0.12e-3;
    d.frame();
    CHECK(near(d.at(), before + back));  // the hand moves in the same frame
  }
}

TEST_CASE("a deflected stick sets the hand's position, and a released stick returns it to the middle") {
  Driver d;
  d.input.controllers = {gamepad({0.0f, 0.0f, 0.0f})};
  d.frame();
  d.input.controllers[0].gamepad->axes = {1.0f, -1.0f, 0.0f};  // right, forward
  d.frame();
  CHECK(near(d.at(), {0.06, 0.05}));
  d.input.controllers[0].gamepad->axes = {-0.6f, 0.1f, 0.0f};
  d.frame();
  CHECK(d.at().x == doctest::Approx(-0.5 * 0.06));  // (0.6 - dead zone 0.2) / 0.8 is half of the reach
  CHECK(d.at().y == 0.0);                           // inside the dead zone
  d.input.controllers[0].gamepad->axes = {0.0f, 0.0f, 0.0f};
  d.frame();
  CHECK(near(d.at(), {0.0, 0.0}));
  // A stick at rest does not move the hand, so keys can move it.
  d.key(GLFW_KEY_RIGHT, true);
  d.frame(0.1);
  CHECK(near(d.at(), {0.025, 0.0}));
}

TEST_CASE("in mode `moves` the hand's speed is quadratic in the deflection beyond the dead zone, at any frame rate") {
  Bindings custom = bindings();
  custom.lever.mode = LeverMode::moves;
  custom.lever.speed = 0.3;
  for (const int parts : {1, 10}) {
    DriverInput driver({custom, {0.06, 0.05}});
    WindowInput input;
    input.controllers = {gamepad({0.0f, 0.0f, 0.0f})};
    const auto frames = [&](double seconds) {
      for (int i = 0; i < parts; ++i) driver.update(input, seconds / parts, false, false);
    };
    frames(0.1);
    input.controllers[0].gamepad->axes = {1.0f, -0.6f,
                                          0.0f};  // fully right; forward by half of the range beyond the dead zone
    frames(0.1);
    CHECK(driver.hand().position.x == doctest::Approx(0.3 * 0.1));
    CHECK(driver.hand().position.y == doctest::Approx(0.3 * 0.1 / 4.0));
    input.controllers[0].gamepad->axes = {0.1f, 0.15f, 0.0f};  // the released stick trembles inside its dead zone
    driver.feel({0.03, 0.0075});                               // the lever has followed the hand
    const glm::dvec2 stays = driver.hand().position;
    for (int i = 0; i < 50; ++i) frames(0.1);
    CHECK(near(driver.hand().position, stays));
    input.controllers[0].gamepad->axes = {-1.0f, 0.0f, 0.0f};
    frames(100.0);
    CHECK(driver.hand().position.x == doctest::Approx(0.03 - 0.05));  // the hand stays within 50 mm of a blocked lever
    CHECK(driver.hand().push == glm::dvec2(0.0));
  }
}

TEST_CASE("a pad's stop button always works, even if the window does not have the focus") {
  Bindings custom = bindings();
  custom.pad_buttons = {{Action::stop, {1}}};
  DriverInput driver({custom, {0.06, 0.05}});
  WindowInput input;
  input.controllers = {gamepad({})};
  driver.update(input, kFrame, true, true);
  input.controllers = {gamepad({}, {0, 1})};
  driver.update(input, kFrame, true, true);
  CHECK(driver.pressed() == std::vector{Action::stop});
  input.controllers[0].gamepad->buttons = {0, 0};
  driver.update(input, kFrame, false, false);
  input.focused = false;
  driver.update(input, kFrame, false, false);
  input.controllers[0].gamepad->buttons = {0, 1};
  driver.update(input, kFrame, true, true);
  CHECK(driver.pressed() == std::vector{Action::stop});
}

TEST_CASE("axes and buttons bound by a stick's name follow that stick to any port, and ignore other sticks") {
  Bindings custom = bindings();
  custom.throttle = AxisBinding{.of = {"pedals", ""}, .from = 0.0};
  custom.clutch = AxisBinding{.of = {"pedals", ""}, .which = 1, .from = 0.0};  // the second one with a matching name
  custom.lever_select.reset();
  custom.lever_shift.reset();
  custom.pad_buttons.clear();
  custom.controllers = {{{"Wheel", ""}, 0, {{Action::starter, {0}}}, {}}};
  const auto drive = [&](const std::vector<std::size_t>& order) {
    std::vector<Controller> all{controller("Acme Pedals", {0.25f}, 1), controller("Some Wheel", {0.5f}, 1),
                                controller("PEDALS two", {0.75f}, 1)};
    all[0].buttons[0] = all[2].buttons[0] = 1;
    WindowInput input;
    for (const std::size_t i : order) input.controllers.push_back(all[i]);
    DriverInput driver({custom, {0.06, 0.05}});
    for (const float moved : {0.0f, 0.0625f, 0.0625f}) {
      for (Controller& one : input.controllers) one.axes[0] += moved;
      driver.update(input, kFrame, false, false);
    }
    return driver.controls();
  };
  CHECK(drive({0, 1, 2}).pedals.throttle == doctest::Approx(0.375));
  CHECK(drive({0, 1, 2}).pedals.clutch == doctest::Approx(0.875));
  // The order in which different sticks are connected does not matter.
  CHECK(drive({1, 0, 2}).pedals.throttle == doctest::Approx(0.375));
  CHECK(drive({1, 2}).pedals.throttle == doctest::Approx(0.875));
  CHECK(drive({1, 2}).pedals.clutch == 0.0);  // only one connected stick has a matching name
  CHECK(drive({1}).pedals.throttle == 0.0);
  CHECK_FALSE(drive({0, 1, 2}).starter);  // the pressed button is on the pedals, not on the wheel
}

TEST_CASE("panel input does not reach the driver, except keys that type no text; held keys are released") {
  Driver d;
  d.key(GLFW_KEY_D, true);
  d.frame();
  d.key(GLFW_KEY_RIGHT, true);
  d.key(GLFW_KEY_SPACE, true);
  d.key(GLFW_KEY_F11, true);
  d.frame(kFrame, true, true);
  CHECK(d.driver.pressed().empty());
  CHECK(near(d.at(), {0.0, 0.0}));
  d.key(GLFW_KEY_F12, true);
  d.key(GLFW_KEY_D, false);
  d.frame(kFrame, true, true);
  CHECK(d.driver.pressed() == std::vector{Action::stop});
  for (int i = 0; i < 10; ++i) d.frame(kFrame, true, true);
  CHECK(d.pedals.throttle == 0.0);
}

TEST_CASE("when the window loses the focus, all keys are released") {
  Driver d;
  d.click();
  d.key(GLFW_KEY_RIGHT, true);
  d.key(GLFW_KEY_D, true);
  d.frame();
  d.input.focused = false;
  d.frame();
  const glm::dvec2 stays = d.at();
  CHECK_FALSE(d.driver.mouse_moves_lever());
  d.input.mouse_moved = {100.0, 100.0};
  for (int i = 0; i < 30; ++i) d.frame();
  CHECK(near(d.at(), stays));
  CHECK(d.pedals.throttle == 0.0);
}

// Without a window manager, an X server never reports that a window has the focus.
TEST_CASE("a window that never had the focus still receives its keys") {
  Driver d;
  d.input.focused = false;
  d.key(GLFW_KEY_RIGHT, true);
  for (int i = 0; i < 10; ++i) d.frame();
  CHECK(near(d.at(), {0.025, 0.0}));
}

TEST_CASE("equal input gives exactly equal output") {
  Driver a, b;
  for (Driver* d : {&a, &b}) {
    std::mt19937 chance(9);
    d->click();
    for (int i = 0; i < 2000; ++i) {
      d->input.mouse_moved = {static_cast<double>(chance() % 21) - 10.0, static_cast<double>(chance() % 21) - 10.0};
      d->key(GLFW_KEY_SPACE + static_cast<int>(chance() % 300), chance() % 2 == 0);
      d->input.controllers = {gamepad({static_cast<float>(chance() % 100) / 50.0f - 1.0f, 0.0f, 0.3f}, {1, 0, 1})};
      d->frame(0.001 * static_cast<double>(chance() % 40));
    }
  }
  CHECK(a.at() == b.at());
  CHECK(a.driver.controls().pedals.throttle == b.driver.controls().pedals.throttle);
  CHECK(a.pedals.clutch == b.pedals.clutch);
  CHECK(a.driver.pressed() == b.driver.pressed());
}

TEST_CASE("keys move the hand at most 50 mm past a blocked lever; once released, the hand stays at most 5 mm past it") {
  Driver d;
  const glm::dvec2 held{-0.01, 0.005};
  d.key(GLFW_KEY_LEFT, true);
  for (int i = 0; i < 100; ++i) {
    d.driver.feel(held);
    d.frame();
  }
  CHECK(d.at().x == doctest::Approx(held.x - 0.05));
  d.key(GLFW_KEY_LEFT, false);
  for (int i = 0; i < 20; ++i) d.frame();
  CHECK(d.at().x == doctest::Approx(held.x - 0.05));  // the hand first waits, because the lever may still follow
  for (int i = 0; i < 40; ++i) d.frame();
  CHECK(d.at().x == doctest::Approx(held.x - 0.005));
  d.driver.feel({0.0, 0.0});  // a lever that springs back must not pull the hand along
  for (int i = 0; i < 40; ++i) d.frame();
  CHECK(d.at().x == doctest::Approx(held.x - 0.005));
}

TEST_CASE("a hand moved by the mouse after keys is not pulled back to the lever") {
  Driver d;
  d.click();
  d.key(GLFW_KEY_RIGHT, true);
  d.frame();
  d.key(GLFW_KEY_RIGHT, false);
  d.frame();
  d.input.mouse_moved = {200.0, 0.0};
  d.frame();
  const glm::dvec2 there = d.at();
  CHECK(there.x > 0.02);
  for (int i = 0; i < 100; ++i) d.frame();
  CHECK(near(d.at(), there));
}

TEST_CASE(
    "a pedal key pressed and released within a frame counts until the next frame, a longer press until its release") {
  Driver d;
  d.key(GLFW_KEY_A, true);
  d.key(GLFW_KEY_A, false);
  d.frame(0.1);
  CHECK(d.pedals.clutch == doctest::Approx(0.1 / 0.25));
  CHECK(d.driver.pedal_keys().clutch);
  d.frame(0.0);
  CHECK_FALSE(d.driver.pedal_keys().clutch);
  d.key(GLFW_KEY_A, true);
  d.frame();
  d.key(GLFW_KEY_A, false);
  d.frame();
  CHECK_FALSE(d.driver.pedal_keys().clutch);  // a press that lasts a frame ends with the release
}

TEST_CASE("the handbrake follows its axis, a held button and a switch; a pull takes it over from the lesson") {
  Bindings custom = bindings();
  custom.hand_brake = AxisBinding{.of = {"Handbrake", ""}};
  custom.controllers = {{{"Box", ""}, 0, {{Action::hand_brake_hold, {0}}, {Action::hand_brake, {1}}}, {}}};
  Driver d;
  d.driver = DriverInput({custom, {0.06, 0.05}});
  d.input.controllers = {controller("Handbrake", {-1.0f}), controller("Box", {}, 2)};
  float& lever = d.input.controllers[0].axes[0];
  std::vector<unsigned char>& box = d.input.controllers[1].buttons;
  const auto pull = [&](float to) {
    lever = to;
    d.frame();
    return d.driver.controls().pedals.hand_brake;
  };
  const auto press = [&](std::size_t button, bool down) {
    box[button] = down ? 1 : 0;
    d.frame();
    d.frame();
    return d.driver.controls().pedals.hand_brake;
  };
  d.driver.set_car(true, 1.0);  // the lesson starts with the handbrake on
  CHECK(pull(-1.0f) == 1.0);
  CHECK(pull(-0.9f) == 1.0);  // the first report is no motion
  CHECK(pull(-0.5f) == 1.0);  // pulled less than half: still on
  CHECK(pull(1.0f) == 1.0);
  CHECK(pull(0.0f) == doctest::Approx(0.5));  // now it follows the axis
  CHECK(pull(-1.0f) == 0.0);
  d.driver.set_car(true, 1.0);
  CHECK(pull(-1.0f) == 1.0);
  CHECK(press(0, true) == 1.0);
  CHECK(press(0, false) == 0.0);
  CHECK(press(1, true) == 1.0);
  CHECK(press(1, false) == 1.0);
  CHECK(press(1, true) == 0.0);
}

TEST_CASE("after new bindings, keys that are held stay held, and their release counts") {
  Driver d;
  d.key(GLFW_KEY_D, true);
  d.key(GLFW_KEY_X, true);
  d.frame();
  CHECK(d.driver.hand().pressed_down);
  d.driver.rebind(bindings());
  d.frame();
  CHECK(d.driver.hand().pressed_down);
  CHECK(d.driver.pedal_keys().throttle);
  d.key(GLFW_KEY_D, false);
  d.key(GLFW_KEY_X, false);
  d.frame();
  d.frame();
  CHECK_FALSE(d.driver.hand().pressed_down);
  CHECK_FALSE(d.driver.pedal_keys().throttle);
}

TEST_CASE("the throttle goes a tenth per press and stays, also for presses within one frame; the brake lets it off") {
  for (const double frame : {1.0 / 5.0, 1.0 / 144.0}) {
    CAPTURE(frame);
    Driver d;
    Bindings b = bindings();
    b.keys[Action::throttle_more] = {GLFW_KEY_J};
    b.keys[Action::throttle_less] = {GLFW_KEY_K};
    b.keys[Action::brake] = {GLFW_KEY_S};
    d.driver.rebind(b);
    const auto tap = [&d](int key, int times) {
      for (int i = 0; i < times; ++i) {
        d.key(key, true);
        d.key(key, false);
      }
    };
    const auto held = [&] { return d.driver.pedal_keys().held_throttle; };
    tap(GLFW_KEY_J, 4);
    d.frame(frame);
    CHECK(held() == doctest::Approx(0.4));
    d.frame(frame);
    CHECK(held() == doctest::Approx(0.4));
    tap(GLFW_KEY_K, 1);
    d.frame(frame);
    CHECK(held() == doctest::Approx(0.3));
    d.key(GLFW_KEY_J, true);  // held for 1 s: one step at once, and then one per 0.1 s after 0.4 s
    for (double time = 0.0; time < 1.0 - 1e-9; time += frame) d.frame(frame);
    CHECK(held() == doctest::Approx(0.9).epsilon(0.12));
    d.key(GLFW_KEY_J, false);
    tap(GLFW_KEY_J, 20);
    d.frame(frame);
    CHECK(held() == 1.0);
    d.key(GLFW_KEY_S, true);
    d.frame(frame);
    CHECK(held() == 0.0);
  }
}

TEST_CASE(
    "a pedal stays where the mouse put it on the screen, until a key moves it; brake and throttle are one foot's") {
  Driver d;
  d.driver.move_pedal(&Pedals::clutch, 0.6);
  d.driver.move_pedal(&Pedals::throttle, 0.3);
  d.frame();
  CHECK(d.driver.controls().pedals.clutch == 0.6);
  CHECK(d.driver.controls().pedals.throttle == 0.3);
  d.driver.move_pedal(&Pedals::brake, 2.0);
  d.frame();
  CHECK(d.driver.controls().pedals.brake == 1.0);
  CHECK(d.driver.controls().pedals.throttle == 0.0);
  d.key(GLFW_KEY_A, true);
  d.frame();
  CHECK(d.driver.controls().pedals.clutch == 0.0);
  d.driver.set_car(true, 0.0);
  d.frame();
  CHECK(d.driver.controls().pedals.brake == 0.0);
}

TEST_CASE("the key that frees the mouse never captures it") {
  Driver d;
  Bindings b = bindings();
  b.keys[Action::free_mouse] = {GLFW_KEY_N};
  d.driver.rebind(b);
  for (const bool captured : {false, true}) {
    if (captured) d.click();
    d.key(GLFW_KEY_N, true);
    d.key(GLFW_KEY_N, false);
    d.frame();
    CHECK_FALSE(d.driver.mouse_moves_lever());
  }
}
