// The card over the cabin: what it says of a lesson, and what a click on it asks for.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "app/panel/palette.h"
#include "tests/app/panel/coach_views.h"
#include "tests/app/panel/drawn.h"
#include "tests/app/panel/panel_rig.h"

using namespace gearshift;

namespace {

std::vector<KeyHint> some_keys() {
  return {{"clutch", "A"},  {"brake", "S"},      {"throttle", "D"}, {"a little throttle", "F"},
          {"starter", "E"}, {"hand brake", "H"}, {"ignition", "I"}};
}

struct CardRig : PanelRig {
  explicit CardRig(const CoachView& coach, bool panel_shown = false) {
    panel.set_visible(panel_shown);
    show(coach);
  }
  void show(const CoachView& coach) {
    input.coach = coach;
    for (int i = 0; i < 6; ++i) frame();
  }
};

double height_of(const std::string& sentence) {
  const PixelBox box = the_text(drawn_texts(), sentence).box;
  return box.max.y - box.min.y;
}

bool asks_nothing(const LessonRequests& asked) {
  return !asked.begin && !asked.leave && !asked.put_away && !asked.offer && !asked.mode && !asked.help && !asked.next &&
         !asked.learner && !asked.comment;
}

// Drawn on the card: the word or its line stands there.
bool says(const std::string& words) {
  const std::vector<DrawnText> texts = drawn_texts();
  return std::any_of(texts.begin(), texts.end(),
                     [&](const DrawnText& text) { return text.text.find(without_blanks(words)) != std::string::npos; });
}

}  // namespace

TEST_CASE("a lesson on offer is begun, set and put away by a click each, and nothing is asked for without one") {
  CardRig rig(offered());
  CHECK(says("Hill start"));
  CHECK(says("without rolling back"));
  CHECK_FALSE(says("Not passed with"));
  rig.input.lesson_catches = "Not passed with: stall.";
  rig.show(offered());
  CHECK(says("Not passed with: stall."));
  CHECK(asks_nothing(rig.frame().lesson));
  CHECK(rig.click("lesson_begin").lesson.begin);
  CHECK_FALSE(rig.frame().lesson.begin);
  CHECK(rig.click("lesson_put_away").lesson.put_away);
  CHECK(rig.click("mode").lesson.mode == LessonMode::by_yourself);
  CHECK(rig.click("help").lesson.help == false);
  CoachView other = offered();
  other.mode = LessonMode::by_yourself;
  other.help_wanted = false;
  rig.show(other);
  CHECK(rig.click("mode").lesson.mode == LessonMode::follow_me);
  CHECK(rig.click("help").lesson.help == true);
}

TEST_CASE("the card stands where the panel is hidden, too, covers what lies behind it and nothing else") {
  for (const bool panel_shown : {true, false}) {
    CAPTURE(panel_shown);
    CardRig rig(driven(), panel_shown);
    const ControlRect leave = rig.rect("lesson_leave"), middle = rig.panel.middle();
    CHECK(rig.panel.covers(0.5 * (leave.min + leave.max)));
    CHECK_FALSE(rig.panel.covers({640.0, 400.0}));
    CHECK(leave.min.x > middle.min.x);
    CHECK(leave.max.x < middle.max.x);
    CHECK(rig.click("lesson_leave").lesson.leave);
    rig.show(half_way());
    CHECK_FALSE(rig.panel.covers(0.5 * (leave.min + leave.max)));
    CHECK_FALSE(rig.panel.control_rect("lesson_leave").has_value());
  }
}

TEST_CASE("a card leaves the keys to the car, however it is clicked") {
  CardRig rig(offered());
  rig.click("mode");
  rig.click("help");
  rig.frame();
  CHECK_FALSE(rig.panel.has_keyboard());
}

TEST_CASE("the card stands at the foot of the middle and takes its room from the cabin, as much in every phase") {
  for (const bool panel_shown : {true, false}) {
    CAPTURE(panel_shown);
    CardRig rig(half_way(), panel_shown);
    rig.input.keys = some_keys();
    const ControlRect whole = rig.panel.middle();
    rig.show(offered());
    const ControlRect middle = rig.panel.middle();
    CHECK(middle.max.y < 0.78 * whole.max.y);
    CHECK(middle.max.y > 0.60 * whole.max.y);
    CHECK(rig.rect("lesson_begin").min.y > middle.max.y);
    CHECK(rig.panel.covers({0.5 * (whole.min.x + whole.max.x), whole.max.y - 20.0}));
    CHECK_FALSE(rig.panel.covers({0.5 * (whole.min.x + whole.max.x), middle.max.y - 2.0}));
    for (const CoachView& coach : {driven(), over(result_of("hill_start", some_faults())), offered()}) {
      rig.input.coach = coach;
      rig.frame();  // already in its first frame
      CHECK(rig.panel.middle().max.y <= middle.max.y);
      rig.show(coach);
    }
    const double settled = rig.panel.middle().max.y;  // what the longest of its texts needs
    CHECK(settled > 0.55 * whole.max.y);
    for (const CoachView& coach : {driven(), over(result_of("hill_start", some_faults())), offered()}) {
      rig.input.coach = coach;
      rig.frame();
      CHECK(rig.panel.middle().max.y == settled);
    }
    rig.show(half_way());
    CHECK(rig.panel.middle().max.y == whole.max.y);
  }
}

TEST_CASE(
    "no prompt of the shipped lessons, with its hint and what was said, takes more than 40 % of a cabin 1280 x 720") {
  CardRig rig(driven(), true);
  rig.input.keys = some_keys();
  for (const std::string_view key : kTeachingOrder) {
    const Lesson lesson = shipped_lesson(key);
    for (std::size_t step = 0; step < lesson.steps.size(); ++step) {
      CAPTURE(lesson.key);
      CAPTURE(step);
      CoachView coach = driven(key);
      coach.now.prompt = lesson.steps[step].prompt;
      coach.now.hint = lesson.steps[step].hint;
      rig.show(coach);
      CHECK(rig.panel.middle().max.y > 0.6 * 651.0);
      CHECK(says(coach.now.said.back()));
    }
  }
}

TEST_CASE("the button that Enter presses says so: again where it was not passed, the next one where it was") {
  CardRig rig(over(result_of("hill_start", some_faults())));
  rig.input.now.guard = GuardState::running;
  rig.frame();
  rig.frame();
  CHECK(says("Enter: next lesson"));
  CHECK_FALSE(says("Enter: again"));
  CoachView failed = over(result_of("hill_start", failing_faults()));
  failed.next = "bite_point";
  rig.show(failed);
  CHECK(says("Enter: again"));
  CHECK_FALSE(says("Enter: next lesson"));
  CHECK(rig.click("lesson_next").lesson.offer == "bite_point");
  rig.show(offered());
  CHECK(says("Enter begins"));
  CHECK_FALSE(says("motors"));
}

TEST_CASE("where the forces are off a lesson begins with them, and one that is driven says that they are off") {
  CardRig rig(offered());
  for (const GuardState guard : {GuardState::idle, GuardState::damped, GuardState::released}) {
    rig.input.now.guard = guard;
    rig.show(offered());
    CHECK(says("Enter: motors on, and begin"));
    const PanelRequests asked = rig.click("lesson_begin");
    CHECK(asked.lesson.begin);
    CHECK(asked.arm);
    rig.show(driven());
    CHECK(the_text(drawn_texts(), "Motors off. Enter gives them back.").colour == ink::kBad);
    CHECK_FALSE(rig.frame().arm);
  }
  for (const GuardState guard : {GuardState::running, GuardState::ramping}) {
    rig.input.now.guard = guard;
    rig.show(offered());
    const PanelRequests asked = rig.click("lesson_begin");
    CHECK(asked.lesson.begin);
    CHECK_FALSE(asked.arm);
    rig.show(driven());
    CHECK_FALSE(says("Motors off"));
  }
}

TEST_CASE("what is left of the time is told, in the colour of a warning in its last twenty seconds") {
  CoachView coach = driven();
  coach.result.duration = 30.4;
  CardRig rig(coach);
  CHECK_FALSE(says("left"));  // nobody knows
  coach.time_limit = 90.0;
  rig.show(coach);
  CHECK(the_text(drawn_texts(), "1:00 left").colour == ink::kSoft);
  coach.result.duration = 70.5;
  rig.show(coach);
  CHECK(the_text(drawn_texts(), "0:20 left").colour == ink::kWarn);
}

TEST_CASE("a lesson that ended before its time says that this makes 0, whatever else cost points") {
  LessonResult result = result_of("hill_start", some_faults());
  result.end = LessonEnd::out_of_time;
  grade_result(shipped_lesson("hill_start"), result);
  CardRig rig(over(result));
  CHECK(says("Time is up: 0"));
  CHECK(says("Not passed"));
  CHECK(says("-2.0"));
  result.end = LessonEnd::aborted;
  result.why = "The car rolled back more than a metre.";
  grade_result(shipped_lesson("hill_start"), result);
  rig.show(over(result));
  CHECK(says("The car rolled back more than a metre: 0"));
  CHECK_FALSE(says("Time is up"));
  rig.show(over(result_of("hill_start", some_faults())));
  CHECK_FALSE(says("Time is up"));
  CHECK_FALSE(says(": 0"));
  result.end = LessonEnd::left;
  grade_result(shipped_lesson("hill_start"), result);
  rig.show(over(result));
  CHECK(says("Not finished"));
}

TEST_CASE("the keys stand under goal and prompt, and an engine that stalled is started with the one for it") {
  for (const CoachView& coach : {offered(), driven()}) {
    CardRig rig(coach);
    CHECK_FALSE(says("a little throttle"));
    CHECK_FALSE(says("mouse"));
    rig.input.keys = some_keys();
    rig.show(coach);
    const std::vector<DrawnText> texts = drawn_texts();
    double before = 0.0;
    for (const KeyHint& hint : {some_keys()[0], some_keys()[1]}) {
      const PixelBox cap = the_text(texts, hint.key).box, words = the_text(texts, hint.does).box;
      CHECK(cap.min.x > before);
      CHECK(words.min.x > cap.max.x);
      CHECK(words.min.x - cap.max.x < 20.0);
      before = words.max.x;
    }
    CHECK(says("Click into the cabin: the mouse leads the lever"));
    rig.panel.set_visible(true);
    rig.show(coach);
    CHECK(says("Click beside the panel: the mouse leads the lever"));
    rig.panel.set_visible(false);
    rig.input.mouse_leads = true;
    rig.show(coach);
    CHECK(says("The mouse leads the lever: Esc frees it"));
    CHECK_FALSE(says("Click"));
    rig.input.mouse_leads = false;
    rig.input.by_itself = true;  // neither keys nor mouse do anything
    rig.show(coach);
    CHECK_FALSE(says("Click"));
    CHECK_FALSE(says("a little throttle"));
  }
  CardRig rig(driven());
  rig.input.keys = some_keys();
  rig.show(driven());
  CHECK_FALSE(says("Clutch down"));
  rig.input.car.stalled = true;
  rig.show(driven());
  CHECK(says("Clutch down, then starter [E]"));
  rig.input.keys.clear();
  rig.show(driven());
  CHECK(says("Clutch down, then starter."));
}

TEST_CASE("a hidden panel's card tells of pedals, engine, hand brake and slope; a shown one leaves them to the bar") {
  CardRig rig(driven());
  rig.input.car.engine_speed = 240.0;
  rig.input.car.hand_brake = 1.0;
  rig.input.car.slope = std::atan(0.1);
  rig.show(driven());
  for (const char* words : {"clutch", "brake", "throttle", "2292 rpm", "hand brake", "10 % uphill"}) CHECK(says(words));
  const auto blue = [] { return drawn_in(ink::kAccent).size(); };
  const std::size_t up = blue();
  rig.input.car.clutch = 0.5;
  rig.show(driven());
  CHECK(blue() > up);
  rig.input.car.stalled = true;
  rig.show(driven());
  CHECK(says("stalled"));
  rig.panel.set_visible(true);
  rig.show(driven());
  CHECK_FALSE(says("10 % uphill"));
  CHECK(says("Slope +10 %"));
}

TEST_CASE("whether a trial is guided is told while it is driven, not before, and a test says that it is one") {
  CoachView coach = offered();
  coach.guidance = 0.8;
  CardRig rig(coach);
  CHECK_FALSE(says("guided"));
  coach = driven();
  rig.show(coach);
  CHECK_FALSE(says("guided"));
  CHECK_FALSE(says("test: no help"));
  coach.guidance = 0.8;
  rig.show(coach);
  CHECK(says("guided, not graded"));
  coach.guidance = 0.0;
  coach.retention = true;
  rig.show(coach);
  CHECK(says("test: no help"));
  CHECK_FALSE(says("guided"));
}

TEST_CASE("prompt, hint and step are those of the coach, as many parts done as there are steps behind") {
  CoachView coach = driven("reverse");
  coach.now.said.clear();
  CardRig rig(coach);
  CHECK(says(coach.now.prompt));
  CHECK(says("step 3 of 7"));
  const auto parts = [](ImU32 colour) {  // by their left edges
    std::vector<double> edges;
    for (const glm::dvec2 at : drawn_in(colour)) edges.push_back(at.x);
    return edges.empty() ? 0.0 : *std::max_element(edges.begin(), edges.end());
  };
  const double two_done = parts(ink::kGood);
  coach.now.step = 5;
  rig.show(coach);
  CHECK(parts(ink::kGood) > two_done + 50.0);
  CHECK(says("step 6 of 7"));
}

TEST_CASE("what was said last is large for some seconds, then as small as what was said before it") {
  const std::string first = "The lever moved 0.12 s before the clutch was down.", second = "The engine stalled.";
  CoachView coach = driven();
  coach.now.hint.clear();
  coach.now.said = {first};
  CardRig rig(coach);
  const double large = height_of(first);
  rig.screen.seconds = 1.0f;
  for (int i = 0; i < 8; ++i) rig.frame();
  const double small = height_of(first);
  CHECK(large > 1.15 * small);
  coach.now.said = {first, second};
  rig.input.coach = coach;
  rig.frame();
  rig.frame();
  CHECK(height_of(first) == doctest::Approx(small));
  CHECK(the_text(drawn_texts(), second).box.max.y < the_text(drawn_texts(), first).box.min.y);
  const double said = height_of(second);
  for (int i = 0; i < 8; ++i) rig.frame();
  CHECK(said > 1.15 * height_of(second));
}

TEST_CASE("already in a phase's first frame the card has its foot: buttons and keys stand on it, whole") {
  for (const bool panel_shown : {true, false}) {
    CAPTURE(panel_shown);
    for (const CoachView& coach : {offered(), over(result_of("hill_start", failing_faults()))}) {
      CardRig rig(half_way(), panel_shown);
      rig.input.keys = some_keys();
      rig.input.coach = coach;
      rig.frame();
      rig.frame();  // a window that is new is not drawn in its first frame
      const bool is_over = coach.phase == LessonPhase::over;
      const ControlRect button = rig.rect(is_over ? "lesson_again" : "lesson_begin");
      const double foot = panel_shown ? rig.rect("stop").min.y : 720.0;
      CHECK(button.max.y < foot);
      CHECK(says(is_over ? "again" : "begin"));
    }
    CardRig rig(driven(), panel_shown);  // the card stands already
    rig.input.coach = over(result_of("hill_start", failing_faults()));
    rig.frame();
    CHECK(rig.panel.control_rect("lesson_again").has_value());
    CHECK(rig.panel.control_rect("lesson_put_away").has_value());
    CHECK(says("again"));
    CHECK(says("Close"));
    CHECK(says("Once more"));
    CHECK(says("Not passed"));
  }
}

TEST_CASE("that the teacher holds the car is said as long as it is so, and how it is given back") {
  const LessonResult passed = result_of("hill_start", some_faults());
  for (const bool is_over : {true, false}) {
    CardRig rig(is_over ? over(passed) : offered());
    CHECK_FALSE(says("teacher"));
    rig.input.teacher_holds = true;
    rig.frame();
    rig.frame();
    CHECK(says("The teacher holds clutch and brake"));
    CHECK(says(is_over ? "Close gives them back" : "Not now gives them back"));
  }
}

TEST_CASE("a trial that cannot be passed any more says so while it is driven, once, and what to do") {
  CardRig rig(driven());
  CHECK_FALSE(says("not passed any more"));
  rig.input.trial_lost = true;
  rig.show(driven());
  const std::vector<DrawnText> texts = drawn_texts();
  CHECK(std::count_if(texts.begin(), texts.end(), [](const DrawnText& text) {
          return text.text.find(without_blanks("not passed any more")) != std::string::npos;
        }) == 1);
  CHECK(says("go on to learn"));
  rig.show(over(result_of("hill_start", failing_faults())));
  CHECK_FALSE(says("not passed any more"));
}

TEST_CASE("points that are taken off and the grade make ten, and each names its fault and its time") {
  CardRig rig(over(result_of("hill_start", some_faults())));
  double taken = 0.0;
  int lines = 0;
  for (const DrawnText& text : drawn_texts()) {
    if (text.text.front() != '-' || text.text.size() != 4) continue;
    taken -= std::atof(text.text.c_str());
    ++lines;
  }
  CHECK(lines == 2);
  CHECK(10.0 - taken == doctest::Approx(7.5));
  const DrawnText grade = the_text(drawn_texts(), "7.5");
  for (const DrawnText& text : drawn_texts())
    CHECK(text.box.max.y - text.box.min.y <= grade.box.max.y - grade.box.min.y);
  CHECK(right_of("7.9 s") == std::vector<std::string>{without_blanks("The gear ground, 12.4 J."), "-2.0"});
  CHECK(says("Passed"));
  CHECK_FALSE(says("wrong slot"));  // a note
}

TEST_CASE("after a lesson it is driven again or the next one offered, by a click; a guided one has no grade") {
  CardRig rig(over(result_of("hill_start", some_faults())));
  CHECK(rig.click("lesson_again").lesson.begin);
  CHECK(rig.click("lesson_next").lesson.offer == "emergency_stop");
  CHECK(rig.click("lesson_put_away").lesson.put_away);
  CHECK(says("Emergency stop"));
  rig.show(over(result_of("hill_start", failing_faults())));
  CHECK(says("Not passed"));
  CHECK(says("The engine stalled, from 592 rpm."));
  CHECK_FALSE(rig.panel.control_rect("lesson_next").has_value());  // it is the same one
  rig.show(over(result_of("hill_start", some_faults(), true)));
  CHECK(says("graded"));
  CHECK_FALSE(says("Passed"));
  CHECK_FALSE(says("0.0"));
  CHECK_FALSE(says("10.0"));
  CHECK_FALSE(says("-2.0"));
}
