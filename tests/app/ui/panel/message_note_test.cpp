// A message that is too long for the status bar is shown over the cabin once, for some seconds.
#include <string>

#include <doctest/doctest.h>

#include "tests/app/ui/panel/coach_views.h"
#include "tests/app/ui/panel/drawn.h"
#include "tests/app/ui/panel/panel_pictures.h"
#include "tests/app/ui/panel/panel_rig.h"

using namespace gearshift::lessons;
using namespace gearshift::test;

namespace {

const std::string kLong =
    "Another program deleted Ada, so this session is no longer saved. Choose or enter a learner to continue.";

// Whether a line that begins with `begin` is drawn in the upper 120 px of the screen.
bool is_over_cabin(const std::string& begin) {
  for (const DrawnText& text : drawn_texts())
    if (text.text.starts_with(without_blanks(begin)) && text.box.max.y < 120.0) return true;
  return false;
}

void show_message(PanelRig& rig, const std::string& message) {
  rig.input.message = message;
  rig.frame();
  rig.frame();
}

}  // namespace

TEST_CASE("with the panel hidden a new message is shown over the cabin for eight seconds") {
  PanelRig rig;
  rig.panel.set_visible(false);
  rig.wait(10.0);
  CHECK_FALSE(is_over_cabin("Ready."));
  show_message(rig, kLong);
  CHECK(is_over_cabin("Another program deleted Ada"));
  rig.wait(7.5);
  CHECK(is_over_cabin("Another program deleted Ada"));
  rig.wait(1.0);
  CHECK_FALSE(is_over_cabin("Another program deleted Ada"));
  show_message(rig, "Another one.");
  CHECK(is_over_cabin("Another one."));
}

TEST_CASE("a message shown in the bar is not repeated; one that does not fit is shown over the cabin") {
  PanelRig rig;
  rig.screen.width = 1920.0f;
  rig.screen.height = 1080.0f;
  show_message(rig, "Saved.");
  CHECK(is_drawn("Saved."));
  CHECK_FALSE(is_over_cabin("Saved."));
  show_message(rig, kLong + " " + kLong + " " + kLong);
  CHECK(is_over_cabin("Another program deleted Ada"));
}

TEST_CASE("a message over the cabin and a comment that is being edited both fit") {
  PanelRig rig;
  CoachState coach = with_history();
  coach.learner_deleted = true;
  coach.runs[0].comments[0].id = 7;
  rig.input.coach = coach;
  show_message(rig, kLong + " " + kLong);
  rig.click("tab_history");
  rig.click("run: 16");
  rig.click("comment_edit: 7");
  rig.input.opening = "moving_off-20261122-000929-29480.trace";
  show(rig, "message_and_edit.png");
  CHECK(rig.panel.shortened_texts() == 0);
}
