// The learner's and the instructor's view on every screen size and in one eye of a headset, with and without the panel.
#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/ui/ui_style.h"
#include "tests/app/lessons/replay/lesson_trace.h"
#include "tests/app/ui/panel/coach_views.h"
#include "tests/app/ui/panel/drawn.h"
#include "tests/app/ui/panel/panel_pictures.h"

using namespace gearshift::engine;
using namespace gearshift::lessons;
using namespace gearshift::test;
using namespace gearshift::ui;

namespace {

std::vector<Screen> all_screens() {
  std::vector<Screen> screens(std::begin(kScreens), std::end(kScreens));
  screens.push_back(kEye);
  return screens;
}

double text_width(const char* text) {  // [px] width in the small font
  ImFont* font = ui_font(UiFont::small);
  return static_cast<double>(font->CalcTextSizeA(ui_font_size(font), 1e9f, 0.0f, text).x);
}

void check_inside(const PanelRig& rig, const ControlRect& room, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    CAPTURE(name);
    const ControlRect r = rig.rect(name);
    CHECK(r.min.x >= room.min.x);
    CHECK(r.min.y >= room.min.y);
    CHECK(r.max.x <= room.max.x);
    CHECK(r.max.y <= room.max.y);
  }
}

struct Moment {
  const char* name;
  CoachState coach;
  std::vector<std::string> controls;  // names of controls that must be visible
};

std::vector<Moment> moments() {
  CoachState by_yourself = offered("another_gate"), guided = driven("bite_point"), test = driven("reverse");
  by_yourself.mode = LessonMode::by_yourself;
  by_yourself.help_wanted = false;
  guided.guidance = 0.7;
  guided.now.feedback.clear();
  guided.time_limit = 90.0;
  guided.result.duration = 78.0;
  LessonResult late = result_of("hill_start", failing_errors());
  late.end = LessonEnd::out_of_time;
  grade_result(shipped_lesson("hill_start"), late);
  test.retention = true;
  test.now.hint.clear();
  test.now.feedback.clear();
  const std::vector<std::string> offer{"lesson_begin", "mode", "help", "lesson_dismiss"};
  const std::vector<std::string> end{"lesson_again", "lesson_dismiss"};
  return {{"offered", offered(), offer},
          {"offered_alone", by_yourself, offer},
          {"driving", driven(), {"lesson_leave"}},
          {"driving_guided", guided, {"lesson_leave"}},
          {"driving_test", test, {"lesson_leave"}},
          {"over_passed", over(result_of("hill_start", some_errors())), {"lesson_again", "lesson_next"}},
          {"over_norm", over(with_norm(result_of("hill_start", some_errors()))), {"lesson_again", "lesson_next"}},
          {"over_best", over(result_of("hill_start", {})), end},
          {"over_failed", over(result_of("hill_start", failing_errors())), end},
          {"over_late", over(late), end},
          {"over_guided", over(result_of("hill_start", some_errors(), true)), end}};
}

}  // namespace

TEST_CASE("a lesson's card fits on every screen, below the cabin and without touching the status bar") {
  for (const Screen& screen : all_screens()) {
    CAPTURE(screen.width);
    CAPTURE(screen.scale);
    PanelRig rig;
    show_on(rig, screen);
    rig.input.keys = {{"clutch", "A"},  {"brake", "S"},      {"throttle", "D"},  {"a little throttle", "F"},
                      {"starter", "E"}, {"hand brake", "H"}, {"lever", "arrows"}};
    rig.input.car.slope = 0.0997;
    rig.input.car.pedals.hand_brake = 1.0;
    rig.input.car.pedals.clutch = 0.6;
    for (const Moment& moment : moments()) {
      CAPTURE(moment.name);
      rig.input.coach = moment.coach;
      show(rig, name_of(screen, moment.name));
      CHECK(rig.panel.shortened_texts() == 0);
      const ControlRect middle = rig.panel.cabin_area();
      check_inside(rig, {{middle.min.x, middle.max.y}, {middle.max.x, rig.rect("stop").min.y}}, moment.controls);
      if (screen.width > 800) CHECK(middle.max.y > 0.55 * rig.rect("stop").min.y);
    }
    rig.panel.set_visible(false);
    rig.input.coach = moments()[2].coach;
    show(rig, name_of(screen, "driving_hidden"));
    CHECK(rig.panel.shortened_texts() == 0);
  }
}

TEST_CASE("lessons and history fit on every screen, with complete tab names") {
  for (const Screen& screen : all_screens()) {
    CAPTURE(screen.width);
    CAPTURE(screen.scale);
    PanelRig rig;
    show_on(rig, screen);
    rig.input.coach = with_history();
    rig.input.coach.next_by_instructor = true;
    show(rig, name_of(screen, "lessons"));
    CHECK(rig.panel.shortened_texts() == 0);
    const double width = screen.width, height = screen.height;
    check_inside(rig, {{rig.panel.cabin_area().max.x, 0.0}, {width, height}},
                 {"car", "learner", "learner_known", "lesson_suggested", "next_as_suggested", "lesson: start_and_stop",
                  "next: start_and_stop", "tab_presets"});
    int seen = 0;
    for (const LessonStanding& lesson : rig.input.coach.lessons) {
      CAPTURE(lesson.title);
      if (!rig.panel.control_rect("next: " + lesson.key) || !is_drawn(lesson.title)) break;  // the list scrolls
      ++seen;
      // The title of `hill_start` is drawn twice. The first one drawn is the suggestion above the list.
      const PixelBox box = the_text(drawn_texts(), lesson.title).box;
      CHECK(box.min.x >= rig.panel.cabin_area().max.x);
      CHECK(box.max.x <= rig.rect("next: " + lesson.key).min.x);
    }
    CHECK(seen >= 3);
    const struct {
      const char* name;
      const char* label;
    } tabs[] = {{"tab_lesson", "Lessons"}, {"tab_history", "History"}, {"tab_tuning", "Tuning"},
                {"tab_setup", "Setup"},    {"tab_loop", "Loop"},       {"tab_presets", "Presets"}};
    for (const auto& tab : tabs) {
      const ControlRect r = rig.rect(tab.name);
      CHECK(r.max.x - r.min.x >= text_width(tab.label));
    }
    rig.click("tab_history");
    rig.click("run: 16");
    show(rig, name_of(screen, "history"));
    CHECK(rig.panel.shortened_texts() == 0);
    check_inside(rig, {{rig.panel.cabin_area().max.x, 0.0}, {width, height}}, {"run: 16", "look: 16 0", "look: 16 1"});
  }
}

TEST_CASE("a replay fits on every screen, for the whole drive and for each shift") {
  Player player(upshifts().file);
  REQUIRE(player.drive().shifts().size() > 1);
  for (const Screen& screen : all_screens()) {
    CAPTURE(screen.width);
    CAPTURE(screen.scale);
    PanelRig rig;
    show_on(rig, screen);
    rig.input.coach = over(result_of("hill_start", some_errors()));
    player.select_shift(std::nullopt);
    player.seek(player.drive().begin() + 6.0);
    rig.input.replay = &player;
    rig.input.now = player.now().lever;
    rig.input.car = player.now().car;
    show(rig, name_of(screen, "replay"));
    CHECK(rig.panel.shortened_texts() == 0);
    player.select_shift(1);
    player.seek(0.5 * (player.from() + player.to()));
    rig.input.now = player.now().lever;
    rig.input.car = player.now().car;
    show(rig, name_of(screen, "replay_shift"));
    CHECK(rig.panel.shortened_texts() == 0);
    const double width = screen.width, height = screen.height;
    check_inside(rig, {{0.0, rig.panel.cabin_area().max.y}, {width, height}},
                 {"replay_time", "replay_play", "replay_pace: 0.1", "replay_pace: 2", "replay_whole", "replay_close",
                  "replay_shift: 0", "replay_shift: 1"});
    rig.panel.set_visible(false);
    show(rig, name_of(screen, "replay_hidden"));
    CHECK(rig.panel.control_rect("replay_time").has_value());
    CHECK_FALSE(rig.panel.control_rect("lesson_again").has_value());
  }
}
