// The panel's tab for the headset: its texts and its commands.
#include <string>

#include <doctest/doctest.h>

#include "tests/app/ui/panel/drawn.h"
#include "tests/app/ui/panel/panel_rig.h"

using namespace gearshift::cabin;
using namespace gearshift::test;
using namespace gearshift::ui;

namespace {

struct HeadsetTabRig : PanelRig {
  HeadsetTabRig() {
    input.headset.emplace();
    HeadsetReport& headset = *input.headset;
    headset.headset = "Simulated HMD";
    headset.runtime = "Monado 24.0.0";
    headset.state = "focused";
    headset.is_tracked = true;
    headset.eye = {1440, 1600};
    headset.timing = {11.1, 4.2, 7.5, 3.0, 0.0, 5400, 12, 3};
    frame();
    frame();
    (void)click("tab_headset");
    show();
  }
  void show() {
    frame();
    frame();
  }
  // Drags the slider of the length `name` to the right.
  PanelCommands drag_length(const std::string& name) {
    PanelCommands all;
    for (int step = 0; step <= 10; ++step) {
      point(name, 0.2 + 0.06 * step);
      frame();
      merge(all, asked);
      events.mouse_down[0] = true;
    }
    events.mouse_down[0] = false;
    frame();
    return all;
  }
};

}  // namespace

TEST_CASE("without a headset there is no headset tab; with one it shows its frames") {
  PanelRig bare;
  CHECK_FALSE(bare.panel.control_rect("tab_headset").has_value());
  HeadsetTabRig rig;
  for (const char* words : {"Simulated HMD", "Monado 24.0.0", "focused", "2 x 1440 x 1600", "90 Hz, period 11.1 ms",
                            "4.2 ms", "7.5 ms", "3.0 ms before display", "as predicted", "12 of 5412", "3 of 5400"})
    CHECK_MESSAGE(is_drawn(words), words);
  rig.input.headset->timing.spare_ms = -2.0;
  rig.input.headset->timing.late_ms = 11.1;
  rig.input.headset->is_tracked = false;
  rig.show();
  for (const char* words : {"2.0 ms too late", "11.1 ms later than predicted", "focused, not tracked"})
    CHECK_MESSAGE(is_drawn(words), words);
  CHECK(rig.panel.shortened_texts() == 0);
  rig.input.headset->orientation_only = true;
  rig.show();
  CHECK(is_drawn("focused, position unknown"));
  CHECK(rig.panel.shortened_texts() == 0);
}

TEST_CASE("the seat is set by a recentre, by height, by distances, or by touching the knob") {
  HeadsetTabRig rig;
  CHECK(has<RecentreSeat>(rig.click("headset_recentre")));
  const auto raised = find<SetSeatHeight>(rig.drag_length("headset_height"));
  REQUIRE(raised);
  CHECK(raised->height > 0.0);
  CHECK(raised->height <= 0.3);
  const auto asked_knob = value(rig.click("headset_knob"), &SetKnob::knob);
  REQUIRE(asked_knob);
  rig.input.headset->seat.knob = asked_knob;
  rig.show();
  // Entered distances to the knob determine the seat height, so the slider for the height is hidden.
  CHECK_FALSE(rig.panel.control_rect("headset_height").has_value());
  const auto moved = find<SetKnob>(rig.drag_length("headset_knob_down"));
  REQUIRE(moved);
  CHECK(moved->knob.down > asked_knob->down);
  CHECK(moved->knob.right == asked_knob->right);
  CHECK(has<ForgetKnob>(rig.click("headset_knob")));
  CHECK(has<StartTouching>(rig.click("headset_touch")));
  rig.input.headset->touching = true;
  rig.input.headset->touches = 3;
  rig.input.headset->worst_touch = 0.0042;
  rig.show();
  CHECK(is_drawn("3 points touched, up to 4 mm off."));
  CHECK(has<SaveTouches>(rig.click("headset_touched")));
  rig.input.headset->touching = false;
  rig.input.stick = StickView{};
  rig.show();
  CHECK(rig.panel.control_rect("headset_touch").has_value());
  rig.input.headset->is_touched = true;
  rig.show();
  CHECK(has<ForgetTouches>(rig.click("headset_forget")));
}
