// A stick in the user's hand: the panel shows the stick's state and instructions, and says that the push is only
// estimated.
#include <string>

#include <doctest/doctest.h>

#include "tests/app/ui/panel/drawn.h"
#include "tests/app/ui/panel/panel_rig.h"

using namespace gearshift::engine;
using namespace gearshift::haptics;
using namespace gearshift::test;
using namespace gearshift::ui;

namespace {

struct StickRig : PanelRig {
  StickRig() {
    device.simulated = false;
    input.stick = StickView{true, 0.0034};
    input.device_name = "FFBoard";
    input.hands.clear();
    input.hand_name = "a person's";
    show();
  }
  void show() {
    frame();
    frame();
  }
};

constexpr const char* kUnplugged = "The stick is unplugged. Plug it in, then press Enter.";
constexpr const char* kOff = "The stick's forces are off. Hold the stick, then press Enter.";

}  // namespace

TEST_CASE("the panel shows the stick, whether it is plugged in and its delay; there is no choice of hand") {
  StickRig rig;
  CHECK(is_drawn("FFBoard"));
  CHECK(is_drawn("plugged in, responds after 3.4 ms"));
  CHECK(is_drawn("a person's"));
  CHECK_FALSE(rig.panel.control_rect("hand").has_value());
  rig.input.stick->plugged_in = false;
  rig.show();
  CHECK(is_drawn("unplugged"));
  CHECK(rig.panel.shortened_texts() == 0);
}

TEST_CASE("an instruction stays over the cabin until it is followed, also while the panel is hidden") {
  for (const bool visible : {true, false}) {
    CAPTURE(visible);
    StickRig rig;
    rig.panel.set_visible(visible);
    rig.wait(20.0);
    CHECK(is_drawn(kOff));
    rig.input.stick->plugged_in = false;
    rig.wait(20.0);
    CHECK(is_drawn(kUnplugged));
    rig.input.stick->plugged_in = true;
    for (const GuardState on : {GuardState::armed, GuardState::ramping, GuardState::running}) {
      rig.input.now.guard = on;
      rig.show();
      CHECK_FALSE(is_drawn(kOff));
      CHECK_FALSE(is_drawn(kUnplugged));
    }
    rig.input.stick.reset();  // from now on the lever is simulated
    rig.input.now.guard = GuardState::idle;
    rig.show();
    CHECK_FALSE(is_drawn(kOff));
  }
}

TEST_CASE("an unplugged stick cannot be armed by the button, a connected one can") {
  StickRig rig;
  CHECK(has<Arm>(rig.click("arm")));
  rig.input.stick->plugged_in = false;
  rig.show();
  CHECK_FALSE(has<Arm>(rig.click("arm")));
}

TEST_CASE("without a force sensor, push and warning are marked as estimated, and the text fits") {
  StickRig rig;
  rig.screen.width = 1920.0f;
  rig.screen.height = 1080.0f;
  rig.input.now.flags = kFlagOverPush;
  rig.show();
  CHECK(is_drawn("Over-push"));
  rig.input.now.f_h = {-123.4, -123.4};
  rig.input.now.f_a = rig.input.now.f_j = {-123.4, -123.4};
  rig.input.now.flags |= kFlagPushEstimated;
  rig.show();
  const std::vector<DrawnText> texts = drawn_texts();
  const DrawnText& warning = the_text(texts, "Push (estimated)");
  CHECK(warning.box.max.x < the_text(texts, "Grinding").box.min.x - ui_em());
  bool found = false;
  for (const DrawnText& text : texts) found = found || text.text.find("f_hestimated") != std::string::npos;
  CHECK(found);
  CHECK(rig.panel.shortened_texts() == 0);
}
