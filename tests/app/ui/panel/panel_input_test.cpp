// The panel's input in each frame: snapshots of the lever, and the mouse.
#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "app/ui/panel/palette.h"
#include "tests/app/ui/panel/drawn.h"
#include "tests/app/ui/panel/panel_rig.h"

using namespace gearshift;
using namespace gearshift::haptics;
using namespace gearshift::test;
using namespace gearshift::ui;

namespace {

HapticSnapshot at(double time) {
  HapticSnapshot snapshot;
  snapshot.time_ns = std::llround(1e9 * time);
  snapshot.lever = {0.03 * std::sin(3.0 * time), 0.02 * std::sin(5.0 * time)};
  return snapshot;
}

}  // namespace

TEST_CASE("a snapshot newer than its frame's history does not affect plots and trajectory") {
  PanelRig rig;
  ++rig.input.run;
  const auto corners = [] { return drawn_in(ui::ink::kHand).size() + drawn_in(ui::ink::kLever).size(); };
  double time = 1.0;
  std::size_t before = 0;
  for (int frame = 0; frame < 120; ++frame) {
    for (int cycle = 0; cycle < 16; ++cycle) rig.input.history.push_back(at(time += 1e-3));
    rig.input.now = at(time + 1e-3 * (frame % 3));  // `now` is up to two cycles newer than the history
    rig.frame();
    REQUIRE(2 * corners() > before);
    before = std::max(before, corners());
  }
  CHECK(before > 500);
}

TEST_CASE("every part of the panel covers the area behind it in the same frame, and an open list covers everything") {
  PanelRig rig;
  const glm::dvec2 cabin{640.0, 300.0};
  CHECK_FALSE(rig.panel.covers(cabin));
  for (const char* name : {"stop", "gate", "reset_view"}) {
    const ControlRect r = rig.rect(name);
    CHECK(rig.panel.covers(0.5 * (r.min + r.max)));
  }
  rig.click("gate");
  CHECK(rig.panel.covers(cabin));
  rig.press(kEscape);
  rig.frame();
  CHECK_FALSE(rig.panel.covers(cabin));
  rig.panel.set_visible(false);
  rig.frame();
  CHECK_FALSE(rig.panel.covers({10.0, 700.0}));
  rig.panel.show_help(true, "F1\tthese controls\n");
  for (int i = 0; i < 3; ++i) rig.frame();
  CHECK(rig.panel.covers(cabin));
  rig.panel.show_help(false, "");
  rig.frame();
  CHECK_FALSE(rig.panel.covers(cabin));
}

TEST_CASE("values that need allow_unstable are not requested without it, and requested with it") {
  PanelRig rig;
  rig.click("tab_setup");
  rig.frame();
  rig.click("reversal_limiter");
  CHECK_FALSE(has<Restart>(rig.click("restart")));
  rig.click("study");
  const auto asked = find<Restart>(rig.click("restart"));
  REQUIRE(asked);
  CHECK(asked->config.contact.allow_unstable);
  CHECK_FALSE(asked->config.contact.reversal_limiter);
  CHECK_NOTHROW(admit_tuning(asked->config, rig.device, paper_feel()));
  rig.input.haptics = asked->config;  // as if the program had executed the command
  rig.frame();
  CHECK_FALSE(has<Restart>(rig.click("restart")));
  rig.drag("window_samples", 0.02, 0.5);
  rig.drag("speed_limit_m_per_s", 0.2, 0.8);
  const auto more = find<Restart>(rig.click("restart"));
  REQUIRE(more);
  CHECK(more->config.estimator.window > 20);
  CHECK(more->config.estimator.speed_limit > 50.0);
  CHECK_NOTHROW(check_config(more->config));
}
