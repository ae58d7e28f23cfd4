// The learner's view at many sizes: everything is there and legible, and the mouse alone can drive.
#include "app/ui/panel/learner_view.h"

#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <string>

#include <doctest/doctest.h>

#include "app/ui/panel/key_legend.h"
#include "app/ui/panel/palette.h"
#include "tests/app/ui/panel/coach_views.h"
#include "tests/app/ui/panel/drawn.h"
#include "tests/app/ui/panel/panel_rig.h"

using namespace gearshift;
using namespace gearshift::test;
using namespace gearshift::ui;

namespace {

struct LearnerRig : PanelRig {
  vehicle::EngineSpec motor;
  lessons::DriveCondition step;

  LearnerRig() {
    panel.set_view(PanelView::learner);
    input.message.clear();
    input.engine = &motor;
    input.car.clutch_bite = 0.75;
    input.car.clutch_closed = 0.15;
    frame();
    frame();
  }
  void resize(float width, float height) {
    screen.width = width;
    screen.height = height;
    screen.scale = std::max(1.0f, std::floor(4.0f * height / 1080.0f) / 4.0f);  // as UiScale
    for (int i = 0; i < 4; ++i) frame();
  }
};

bool is_inside(const ControlRect& r, double width, double height) {
  return r.min.x >= 0.0 && r.min.y >= 0.0 && r.max.x <= width && r.max.y <= height;
}

bool do_overlap(const ControlRect& a, const ControlRect& b) {
  return a.min.x < b.max.x - 0.5 && b.min.x < a.max.x - 0.5 && a.min.y < b.max.y - 0.5 && b.min.y < a.max.y - 0.5;
}

constexpr const char* kStripControls[] = {"gate",       "pedal_clutch", "pedal_brake", "pedal_throttle",
                                          "hand_brake", "ignition",     "starter",     "lessons",
                                          "view",       "disarm",       "stop"};
const std::vector<KeyHint> kKeys = {{"clutch", "A"},    {"brake", "S"},    {"throttle", "D"},
                                    {"handbrake", "H"}, {"ignition", "I"}, {"starter", "E"}};

}  // namespace

TEST_CASE("at every size the learner's controls are on the screen, apart from each other, and no text is cut") {
  LearnerRig rig;
  rig.input.now.guard = haptics::GuardState::running;
  const glm::vec2 kSizes[] = {{640, 480},  {1280, 720},  {1920, 1080}, {2560, 1440}, {3840, 2160},
                              {720, 1280}, {1080, 1920}, {800, 600},   {1000, 700}};
  for (const glm::vec2 size : kSizes) {
    CAPTURE(size.x);
    CAPTURE(size.y);
    for (const CoachState& coach : {half_way(), offered(), driven(), over(result_of("hill_start", some_errors()))}) {
      rig.input.coach = coach;
      rig.resize(size.x, size.y);
      CHECK(rig.panel.shortened_texts() == 0);
      for (const char* a : kStripControls) {
        CAPTURE(a);
        CHECK(is_inside(rig.rect(a), static_cast<double>(size.x), static_cast<double>(size.y)));
        for (const char* b : kStripControls)
          if (a != b) CHECK_FALSE(do_overlap(rig.rect(a), rig.rect(b)));
      }
      const ControlRect cabin = rig.panel.central_area();
      CHECK(cabin.max.y - cabin.min.y > 0.5 * static_cast<double>(size.y));
      CHECK(cabin.max.y <= rig.rect("gate").min.y);
    }
  }
}

TEST_CASE("pedals are dragged, a click in the gate shifts, and the switches switch: the mouse alone can drive") {
  LearnerRig rig;
  const ControlRect clutch = rig.rect("pedal_clutch");
  const auto drag_to = [&](double fraction) {
    rig.events.mouse = {0.5 * (clutch.min.x + clutch.max.x), clutch.min.y + fraction * (clutch.max.y - clutch.min.y)};
    rig.frame();
    return value(rig.asked, &MovePedal::to);
  };
  (void)drag_to(0.1);
  rig.events.mouse_down[0] = true;
  CHECK(drag_to(0.1).value() == doctest::Approx(0.1).epsilon(0.02));
  CHECK(drag_to(0.7).value() == doctest::Approx(0.7).epsilon(0.02));
  CHECK(drag_to(1.4) == 1.0);  // beyond the end
  CHECK(find<MovePedal>(rig.asked)->pedal == &haptics::Pedals::clutch);
  rig.events.mouse_down[0] = false;
  CHECK_FALSE(drag_to(0.5).has_value());

  const ControlRect gate = rig.rect("gate");
  const auto click_gate = [&](double x, double y) {
    rig.events.mouse = gate.min + glm::dvec2(x, y) * (gate.max - gate.min);
    rig.frame();
    rig.events.mouse_down[0] = true;
    rig.frame();
    rig.events.mouse_down[0] = false;
    PanelCommands all = rig.frame();
    PanelRig::merge(all, rig.frame());
    return value(all, &ShiftTo::gear);
  };
  CHECK(click_gate(0.2, 0.1) ==
        1);  // the paper's gate: 1 at the left front, 4 in the middle at the back, R at the right
  CHECK(click_gate(0.5, 0.9) == 4);
  CHECK(click_gate(0.8, 0.9) == haptics::kReverseGear);
  CHECK(click_gate(0.5, 0.5) == haptics::kNeutralGear);
  CHECK(value(rig.click("hand_brake"), &Press::control) == Action::hand_brake);
  CHECK(value(rig.click("ignition"), &Press::control) == Action::ignition);
  CHECK(has<HoldStarter>(rig.click("starter")));
  CHECK(has<Stop>(rig.click("stop")));
  CHECK(rig.frame().empty());
}

TEST_CASE("the views change by one click, and lessons and history open beside the learner's") {
  LearnerRig rig;
  CHECK_FALSE(rig.panel.control_rect("tab_lesson").has_value());
  (void)rig.click("lessons");
  rig.frame();  // tabs have their places one frame later
  CHECK(rig.panel.control_rect("tab_lesson").has_value());
  CHECK(rig.panel.cabin_area().max.x < 1280.0);
  CHECK_FALSE(rig.panel.control_rect("tab_tuning").has_value());
  (void)rig.click("view");
  rig.frame();
  CHECK(rig.panel.view() == PanelView::engineer);
  CHECK(rig.panel.control_rect("tab_tuning").has_value());
  rig.panel.set_visible(false);
  CHECK(rig.panel.view() == PanelView::hidden);
  rig.panel.set_visible(true);
  CHECK(rig.panel.view() == PanelView::engineer);
}

TEST_CASE("the slot and the way that the lesson wants are lit, and the pedals show what it wants") {
  LearnerRig rig;
  CHECK(drawn_in(ui::ink::kIdeal).empty());
  rig.input.wanted_gear = 1;
  rig.input.way = {{0.0, 0.0}, haptics::rest_position(rig.gate, 1)};
  rig.input.wanted = &rig.step;
  rig.frame();
  const std::vector<glm::dvec2> lit = drawn_in(ui::ink::kIdeal);
  const auto in_gate = [&](const glm::dvec2& p) { return p.x < rig.rect("gate").max.x; };
  CHECK(std::any_of(lit.begin(), lit.end(), in_gate));
  CHECK_FALSE(std::all_of(lit.begin(), lit.end(), in_gate));  // to shift, the clutch is wanted below its bite zone

  const PanelInput shown = rig.input.view(rig.gate, rig.device);
  CHECK(wanted_range(shown, &haptics::Pedals::clutch).from == 0.75);
  CHECK_FALSE(wanted_range(shown, &haptics::Pedals::brake).is_set());
  rig.step.clutch_above = 0.8;
  rig.step.brake_below = 0.05;
  CHECK(wanted_range(shown, &haptics::Pedals::clutch).from == 0.8);
  CHECK(wanted_range(shown, &haptics::Pedals::brake).to == 0.05);
  rig.step = {};
  rig.step.clutch_holds_car = true;
  CHECK(wanted_range(shown, &haptics::Pedals::clutch).from == 0.15);
  CHECK(wanted_range(shown, &haptics::Pedals::clutch).to == 0.75);
}

TEST_CASE("prompts name the key of each control once, as whole words") {
  CHECK(name_inputs("Press the clutch all the way down.", kKeys) == "Press the clutch (A) all the way down.");
  CHECK(name_inputs("Clutch down, brake, and stop. Clutch!", kKeys) == "Clutch (A) down, brake (S), and stop. Clutch!");
  CHECK(name_inputs("Release the handbrake and accelerate to 10 km/h.", kKeys) ==
        "Release the handbrake (H) and accelerate (D) to 10 km/h.");
  CHECK(name_inputs("Raise the revs, without throttle.", kKeys) == "Raise the revs, without throttle (D).");
  CHECK(name_inputs("Start the engine.", kKeys) == "Start the engine (E).");
  CHECK(name_inputs("Switch the engine off.", kKeys) == "Switch the engine off (I).");
  CHECK(name_inputs("Engine braking; unbraked.", kKeys) == "Engine braking; unbraked.");
  CHECK(name_inputs("Press the clutch.", {}) == "Press the clutch.");  // a wheel's own pedal
  CHECK(name_inputs("", kKeys).empty());
}

TEST_CASE("a key that comes too early is answered with the one that comes first") {
  vehicle::VehicleState car;
  car.clutch_bite = 0.75;
  car.running = car.ignition = false;
  CHECK(early_reply({.starter = true}, car, kKeys) == "Ignition first: I.");
  CHECK(early_reply({.throttle = true}, car, kKeys) == "Ignition first: I.");
  CHECK(early_reply({.starter = true}, car, {}) == "Ignition first.");
  car.ignition = true;
  CHECK(early_reply({.starter = true}, car, kKeys).empty());
  CHECK(early_reply({.throttle = true}, car, kKeys) == "Starter first: E.");
  car.gear = 1;
  CHECK(early_reply({.starter = true}, car, kKeys) == "Clutch first: A.");
  car.pedals.clutch = 1.0;
  CHECK(early_reply({.starter = true}, car, kKeys).empty());
  car.running = true;
  CHECK(early_reply({.shifts = true, .throttle = true}, car, kKeys).empty());
  car.pedals.clutch = 0.5;
  CHECK(early_reply({.shifts = true}, car, kKeys) == "Clutch first: A.");
  CHECK(early_reply({.throttle = true}, car, kKeys).empty());
  car.clutch_bite = 0.0;  // no car
  CHECK(early_reply({.shifts = true}, car, kKeys).empty());
}

TEST_CASE("Tab goes through every control of the screen and back to the first, Shift+Tab backwards, Escape leaves") {
  constexpr int kTab = 258, kShift = 340;  // GLFW's key codes
  LearnerRig rig;
  rig.input.now.guard = haptics::GuardState::running;
  rig.input.coach = offered();
  for (int i = 0; i < 4; ++i) rig.frame();
  std::vector<std::string> names(std::begin(kStripControls), std::end(kStripControls));
  for (const char* name : {"lesson_dismiss", "lesson_begin", "mode", "help"}) names.emplace_back(name);
  const auto focused = [&] {
    const ImGuiContext& ui = *ImGui::GetCurrentContext();
    REQUIRE(ui.NavWindow != nullptr);
    const ImRect at = ImGui::WindowRectRelToAbs(ui.NavWindow, ui.NavWindow->NavRectRel[0]);
    for (const std::string& name : names) {
      const ControlRect r = rig.rect(name);
      if (std::abs(r.min.x - static_cast<double>(at.Min.x)) < 2.0 &&
          std::abs(r.min.y - static_cast<double>(at.Min.y)) < 2.0)
        return name;
    }
    return std::string();
  };
  CHECK_FALSE(rig.panel.has_keyboard());
  (void)rig.press(kTab);
  CHECK(rig.panel.has_keyboard());
  const std::string first = focused();
  std::vector<std::string> reached{first};
  for (std::size_t i = 1; i < names.size(); ++i) {
    (void)rig.press(kTab);
    reached.push_back(focused());
  }
  for (const std::string& name : names) {
    CAPTURE(name);
    CHECK(std::count(reached.begin(), reached.end(), name) == 1);
  }
  (void)rig.press(kTab);
  CHECK(focused() == first);
  rig.events.steps = {engine::UiKey{kShift, true}};
  rig.frame();
  (void)rig.press(kTab);
  CHECK(focused() == reached.back());
  rig.events.steps = {engine::UiKey{kShift, false}};
  rig.frame();
  (void)rig.press(kEscape);
  (void)rig.press(kEscape);
  CHECK_FALSE(rig.panel.has_keyboard());
}

TEST_CASE("no tooltip of the bar lies over STOP, at any width") {
  PanelRig rig;
  for (const float width : {700.0f, 900.0f, 1280.0f, 1920.0f}) {
    CAPTURE(width);
    rig.screen.width = width;
    for (int i = 0; i < 3; ++i) rig.frame();
    const ControlRect stop = rig.rect("stop");
    for (double x = 5.0; x < stop.min.x; x += 40.0)
      for (const double y : {stop.min.y + 6.0, stop.max.y - 6.0}) {
        rig.events.mouse = {x, y};
        rig.frame();
        rig.frame();
        for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows)
          if (window->Active && (window->Flags & ImGuiWindowFlags_Tooltip) != 0)
            CHECK(static_cast<double>(window->Pos.y + window->Size.y) <= stop.min.y);
      }
  }
}
