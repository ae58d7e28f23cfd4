// The cards that offer to set up a controller and lead through its steps.
#include "app/ui/panel/controls_card.h"

#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "app/ui/panel/palette.h"
#include "tests/app/ui/panel/drawn.h"
#include "tests/app/ui/panel/panel_rig.h"
#include "tests/support/controllers.h"

using namespace gearshift;
using namespace gearshift::test;
using namespace gearshift::ui;

namespace {

bool shows(const std::string& text) {
  for (const DrawnText& one : drawn_texts())
    if (one.text.find(without_blanks(text)) != std::string::npos) return true;
  return false;
}

void settle(PanelRig& rig) {
  for (int i = 0; i < 4; ++i) rig.frame();
}

std::vector<engine::Controller> desk() {
  return {controller("Logitech G29", {0.0f, 1.0f, 1.0f, 1.0f}, 25), controller("Handbrake", {-1.0f})};
}

}  // namespace

TEST_CASE(
    "a controller without effect is offered with its name, with the panel shown and hidden; without one, nothing") {
  PanelRig rig;
  settle(rig);
  CHECK_FALSE(rig.panel.control_rect("setup_begin"));
  CHECK_FALSE(rig.panel.control_rect("controls_setup"));
  const std::vector<engine::Controller> all = desk();
  std::vector<std::string> offers{"Logitech G29"};
  rig.input.controls = {nullptr, all, offers, {}};
  for (const bool visible : {true, false}) {
    rig.panel.set_visible(visible);
    settle(rig);
    CHECK(shows("Logitech G29 was found. It has no effect until you set it up."));
    CHECK(has<StartControls>(rig.click("setup_begin")));
    CHECK(has<DeclineControls>(rig.click("setup_decline")));
  }
  rig.panel.set_visible(true);
  offers.emplace_back("Handbrake");
  rig.input.controls.offers = offers;
  settle(rig);
  CHECK(shows("Logitech G29, Handbrake were found. They have no effect until you set them up."));
  rig.input.controls.offers = {};
  settle(rig);
  CHECK_FALSE(rig.panel.control_rect("setup_begin"));
  CHECK(has<StartControls>(rig.click("controls_setup")));  // it can be done again at any time
}

TEST_CASE("each step shows its prompt, what was found and only its own answers, in place of the lesson") {
  PanelRig rig;
  std::vector<engine::Controller> all = desk();
  ControlsSetup setup({}, {}, gears_to_set_up());
  rig.input.controls = {&setup, all, {}, {}};
  const auto answers = [&] {
    settle(rig);
    std::vector<std::string> found;
    for (const char* name :
         {"setup_done", "setup_skip", "setup_back", "setup_gears", "setup_paddles", "setup_lever", "setup_other",
          "setup_stays", "setup_returns", "setup_steps", "setup_held", "setup_toggled", "setup_save", "setup_cancel"})
      if (rig.panel.control_rect(name)) found.emplace_back(name);
    return found;
  };
  const auto give = [&](const char* name) {
    const auto answer = find<AnswerControls>(rig.click(name));
    REQUIRE(answer);
    setup.answer(answer->answer);
  };
  using Names = std::vector<std::string>;
  CHECK(answers() == Names{"setup_done", "setup_skip", "setup_cancel"});
  CHECK(shows("Press the CLUTCH pedal"));
  CHECK(shows("step 1 of 5"));
  CHECK(shows("Skip: you cannot use the clutch until something is bound to it."));
  for (int i = 0; i < 3; ++i) give("setup_skip");
  for (const bool down : {false, true}) {
    all[0].buttons[3] = down;
    setup.frame(all, 0.01);
  }
  give("setup_done");
  setup.frame(all, 2.0);
  for (int i = 0; i < AxisDetector::kMinRestFrames; ++i) setup.frame(all, 0.1);
  CHECK(answers() == Names{"setup_back", "setup_held", "setup_toggled", "setup_cancel"});
  give("setup_toggled");
  CHECK(answers() == Names{"setup_back", "setup_gears", "setup_paddles", "setup_lever", "setup_other", "setup_cancel"});
  give("setup_lever");
  CHECK(answers() == Names{"setup_done", "setup_skip", "setup_back", "setup_cancel"});
  CHECK(shows("Move the LEVER to the left"));
  give("setup_skip");
  give("setup_skip");
  CHECK(answers() == Names{"setup_back", "setup_stays", "setup_returns", "setup_steps", "setup_cancel"});
  give("setup_stays");
  CHECK(answers() == Names{"setup_back", "setup_save", "setup_cancel"});
  give("setup_back");
  CHECK(answers() == Names{"setup_back", "setup_stays", "setup_returns", "setup_steps", "setup_cancel"});
  give("setup_stays");
  settle(rig);
  CHECK(has<SaveControls>(rig.click("setup_save")));
  CHECK(has<CancelControls>(rig.click("setup_cancel")));
}

TEST_CASE("the picture moves with the control, and lamps show the buttons that are held") {
  PanelRig rig;
  std::vector<engine::Controller> all = desk();
  ControlsSetup setup({}, {}, gears_to_set_up());
  const auto frame = [&] {
    setup.frame(all, 0.01);
    rig.input.controls = {&setup, all, {}, {}};
    rig.frame();
  };
  frame();
  for (int i = 0; i < 4; ++i) frame();
  const auto lit = [] { return drawn_in(ui::ink::kAccent).size(); };
  const std::size_t at_rest = lit(), lamps = drawn_in(ui::ink::kGood).size();
  for (int i = 1; i <= 20; ++i) {
    all[0].axes[1] = 1.0f - 0.1f * static_cast<float>(i);
    frame();
  }
  CHECK(lit() > at_rest);  // the pedal has become bright
  all[0].buttons[12] = 1;
  frame();
  CHECK(drawn_in(ui::ink::kGood).size() > lamps);
}

TEST_CASE("in the smallest window no answer leaves the screen, with the panel shown and hidden and many controllers") {
  for (const bool visible : {true, false}) {
    PanelRig rig;
    rig.screen.width = 640.0f;
    rig.screen.height = 400.0f;
    std::vector<engine::Controller> all = desk();
    for (int i = 0; i < 4; ++i) all.push_back(controller("Another box with a rather long name", {0.0f, 0.0f}, 60));
    ControlsSetup setup({}, {}, gears_to_set_up());
    rig.panel.set_visible(visible);
    const auto check = [&](std::initializer_list<const char*> names) {
      rig.input.controls = {&setup, all, {}, {}};
      settle(rig);
      for (const char* name : names) {
        CAPTURE(name);
        CAPTURE(visible);
        const ControlRect r = rig.rect(name);
        CHECK(r.min.x >= 0.0);
        CHECK(r.min.y >= 0.0);
        CHECK(r.max.x <= 640.0);
        CHECK(r.max.y <= 400.0);
      }
    };
    check({"setup_done", "setup_skip", "setup_cancel"});
    CHECK(shows("Press the CLUTCH"));
    for (int i = 0; i < 4; ++i) setup.answer(ControlsSetup::Answer::skip);
    check({"setup_gears", "setup_paddles", "setup_lever", "setup_other", "setup_back", "setup_cancel"});
  }
}
