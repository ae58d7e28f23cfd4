// Panel and driver share one window with the shipped bindings. This file tests, frame by frame, which of the two gets
// an input.
#include "app/session/shared_input.h"

#include <string>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <doctest/doctest.h>

#include "app/cabin/view/cabin_view.h"
#include "tests/app/ui/panel/panel_rig.h"

using namespace gearshift::cabin;
using namespace gearshift::engine;
using namespace gearshift::haptics;
using namespace gearshift::session;
using namespace gearshift::test;
using namespace gearshift::ui;

namespace {

struct Desk {
  PanelRig rig;
  SharedInput shared{read_bindings(GEARSHIFT_ASSETS "/bindings/default.toml")};
  DriverInput& driver = shared.driver();
  WindowInput window;
  std::optional<glm::dvec2> mouse;  // [px] mouse position in the panel's picture; if empty, `window.mouse` is used

  Desk() {
    rig.input.now.guard = GuardState::running;
    frame();
    rig.click("tab_tuning");
    frame();
  }

  const PanelCommands& frame() {
    shared.update(
        window, 1.0 / 60.0, [this](glm::dvec2 at) { return mouse ? *mouse : at; }, rig.panel, rig.ui);
    rig.ui.begin(rig.screen);
    rig.asked = rig.panel.draw(rig.input.view(rig.gate, rig.device));
    rig.ui.end();
    window.events.clear();
    return rig.asked;
  }
  // Presses and releases a key, and returns all commands asked in these frames.
  PanelCommands key(int code, bool control = false) {
    window.events = {KeyEvent{code, true, false, control, false}};
    PanelCommands all = frame();
    PanelRig::merge(all, frame());
    window.events = {KeyEvent{code, false, false, control, false}};
    PanelRig::merge(all, frame());
    return all;
  }
  glm::dvec2 middle(const std::string& name) const {
    const ControlRect r = rig.rect(name);
    return 0.5 * (r.min + r.max);
  }
};

}  // namespace

TEST_CASE("a click on STOP counts once, on press, in the frame in which the mouse comes from the cabin") {
  for (const char* name : {"stop", "disarm"}) {
    CAPTURE(name);
    Desk desk;
    desk.frame();
    desk.window.mouse = {640.0, 300.0};
    desk.frame();
    desk.frame();
    desk.window.mouse = desk.middle(name);
    desk.window.mouse_down[0] = true;
    PanelCommands all = desk.frame();
    if (std::string(name) == "stop") CHECK(has<Stop>(all));
    desk.window.mouse_down[0] = false;
    for (int i = 0; i < 3; ++i) {
      const PanelCommands next = desk.frame();
      CHECK_FALSE((has<Stop>(all) && has<Stop>(next)));
      PanelRig::merge(all, next);
    }
    CHECK(has<Stop>(all) == (std::string(name) == "stop"));
    CHECK(has<Disarm>(all) == (std::string(name) == "disarm"));
    CHECK_FALSE(desk.driver.mouse_moves_lever());
  }
  // A click on the cabin moves the hand, even if the mouse was on the panel in the previous frame.
  Desk desk;
  desk.window.mouse = desk.middle("stop");
  desk.frame();
  desk.window.mouse = {640.0, 300.0};
  desk.window.mouse_down[0] = true;
  CHECK_FALSE(has<Stop>(desk.frame()));
  CHECK(desk.driver.mouse_moves_lever());
}

TEST_CASE("a mouse button pressed on the panel is the panel's until it is released") {
  Desk desk;
  desk.window.mouse = desk.middle("wall_stiffness_n_per_m");
  desk.frame();
  desk.window.mouse_down[0] = true;
  desk.frame();
  desk.frame();
  desk.window.mouse = {640.0, 300.0};
  desk.frame();
  CHECK(desk.rig.panel.covers(desk.window.mouse));
  desk.window.mouse_down[0] = false;
  desk.frame();
  desk.frame();
  CHECK_FALSE(desk.rig.panel.covers(desk.window.mouse));
  CHECK_FALSE(desk.driver.mouse_moves_lever());
}

TEST_CASE("with the shipped bindings Tab enters the panel, and its arrow keys do not move the lever") {
  Desk desk;
  desk.frame();
  desk.window.events = {KeyEvent{GLFW_KEY_TAB, true, false, false, false}};
  desk.frame();
  CHECK(desk.driver.pressed().empty());
  desk.window.events = {KeyEvent{GLFW_KEY_TAB, false, false, false, false},
                        KeyEvent{GLFW_KEY_RIGHT, true, false, false, false}};
  desk.frame();
  CHECK(desk.rig.panel.has_keyboard());
  for (int i = 0; i < 10; ++i) desk.frame();
  desk.window.events = {KeyEvent{GLFW_KEY_RIGHT, false, false, false, false}};
  desk.frame();
  desk.key(GLFW_KEY_UP);
  CHECK(desk.driver.hand().position == glm::dvec2(0.0));
  CHECK(desk.rig.panel.visible());
  for (int i = 0; i < 3; ++i) desk.key(GLFW_KEY_ESCAPE);  // leaves the panel
  CHECK_FALSE(desk.rig.panel.has_keyboard());
  CHECK_FALSE(desk.driver.mouse_moves_lever());
  desk.window.events = {KeyEvent{GLFW_KEY_RIGHT, true, false, false, false}};
  for (int i = 0; i < 10; ++i) desk.frame();
  CHECK(desk.driver.hand().position.x > 0.02);
}

TEST_CASE("Ctrl+Tab cycles through the panel's parts, and Space presses the focused control") {
  Desk desk;
  desk.frame();
  desk.key(GLFW_KEY_TAB);
  const auto walk = [&] {
    desk.window.events = {KeyEvent{GLFW_KEY_LEFT_CONTROL, true, false, false, false},
                          KeyEvent{GLFW_KEY_TAB, true, false, true, false}};
    desk.frame();
    desk.window.events = {KeyEvent{GLFW_KEY_TAB, false, false, true, false}};
    desk.frame();
    desk.window.events = {KeyEvent{GLFW_KEY_LEFT_CONTROL, false, false, false, false}};
    desk.frame();
    desk.frame();
  };
  walk();
  CHECK(desk.rig.panel.visible());
  CHECK(desk.rig.panel.has_keyboard());
  desk.key(GLFW_KEY_G, true);
  CHECK_FALSE(desk.driver.mouse_moves_lever());
  for (int i = 0; i < 3; ++i) desk.key(GLFW_KEY_ESCAPE);
  desk.key(GLFW_KEY_TAB);  // Tab moves the focus to the first control of the status bar
  CHECK(has<Disarm>(desk.key(GLFW_KEY_SPACE)));
  CHECK(desk.driver.pressed().empty());
}

TEST_CASE("F2 shows and hides the panel; with Ctrl or Alt held only the keys for STOP work") {
  Desk desk;
  const auto pressed = [&](int key, bool control, bool alt) {
    desk.window.events = {KeyEvent{key, true, false, control, alt}, KeyEvent{key, false, false, control, alt}};
    desk.frame();
    return desk.driver.pressed();
  };
  CHECK(pressed(GLFW_KEY_F2, false, false) == std::vector{Action::panel});
  CHECK(pressed(GLFW_KEY_F2, true, false).empty());
  CHECK(pressed(GLFW_KEY_F2, false, true).empty());
  CHECK(pressed(GLFW_KEY_C, true, false).empty());
  CHECK(pressed(GLFW_KEY_F12, true, true) == std::vector{Action::stop});
  CHECK(pressed(GLFW_KEY_SPACE, true, false) == std::vector{Action::stop});
}

TEST_CASE("Ctrl+click on a slider lets the user type a number, and its digits do not reach the driver") {
  Desk desk;
  desk.window.events = {KeyEvent{GLFW_KEY_LEFT_CONTROL, true, false, false, false}};
  desk.window.mouse = desk.middle("wall_damping_n_s_per_m");
  desk.frame();
  desk.window.mouse_down[0] = true;
  desk.frame();
  desk.window.mouse_down[0] = false;
  desk.frame();
  desk.window.events = {KeyEvent{GLFW_KEY_LEFT_CONTROL, false, false, true, false}};
  desk.frame();
  CHECK(desk.rig.panel.has_keyboard());
  desk.window.events = {KeyEvent{GLFW_KEY_7, true, false, false, false},
                        KeyEvent{GLFW_KEY_7, false, false, false, false}, U'7'};
  PanelCommands all = desk.frame();
  PanelRig::merge(all, desk.key(GLFW_KEY_ENTER));
  REQUIRE(has<ChangeTuning>(all));
  CHECK(find<ChangeTuning>(all)->tuning.wall_damping == 7.0);
}

TEST_CASE("in stereo, the mouse on the panel in either eye's picture is on the panel") {
  Desk desk;
  ViewConfig stereo;
  stereo.stereo = true;
  for (const double eye : {0.0, 1280.0}) {
    desk.window.mouse = desk.middle("stop") + glm::dvec2(eye, 0.0);
    desk.mouse = mouse_in_eye(stereo, desk.window.mouse, {2560, 720});
    desk.frame();
    desk.window.mouse_down[0] = true;
    CHECK(has<Stop>(desk.frame()));
    desk.window.mouse_down[0] = false;
    desk.frame();
    CHECK_FALSE(desk.driver.mouse_moves_lever());
  }
}

TEST_CASE("the right button, pressed outside the panel, turns the view until released") {
  Desk desk;
  const auto drag = [&](glm::dvec2 from, glm::dvec2 to) {
    desk.window.mouse = from;
    desk.frame();
    desk.window.mouse_down[1] = true;
    desk.frame();
    desk.window.mouse = to;
    desk.window.mouse_moved = to - from;
    desk.frame();
    const glm::dvec2 turned = desk.shared.turned();
    desk.window.mouse_moved = {};
    desk.window.mouse_down[1] = false;
    desk.frame();
    return turned;
  };
  const glm::dvec2 cabin{640.0, 300.0}, panel = desk.middle("stop");
  CHECK(drag(cabin, cabin + 5.0) == glm::dvec2(5.0));
  CHECK(drag(cabin, panel) == panel - cabin);
  CHECK(drag(panel, cabin) == glm::dvec2(0.0));
}
