// The lesson card over the cabin: its texts, and the commands of its buttons.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "app/ui/panel/palette.h"
#include "tests/app/ui/panel/coach_views.h"
#include "tests/app/ui/panel/drawn.h"
#include "tests/app/ui/panel/panel_rig.h"

using namespace gearshift;
using namespace gearshift::haptics;
using namespace gearshift::lessons;
using namespace gearshift::test;
using namespace gearshift::ui;

namespace {

std::vector<KeyHint> some_keys() {
  return {{"clutch", "A"},  {"brake", "S"},      {"throttle", "D"}, {"a little throttle", "F"},
          {"starter", "E"}, {"hand brake", "H"}, {"ignition", "I"}};
}

struct CardRig : PanelRig {
  explicit CardRig(const CoachState& coach, bool panel_shown = false) {
    panel.set_visible(panel_shown);
    show(coach);
  }
  void show(const CoachState& coach) {
    input.coach = coach;
    for (int i = 0; i < 6; ++i) frame();
  }
};

double height_of(const std::string& sentence) {
  const PixelBox box = the_text(drawn_texts(), sentence).box;
  return box.max.y - box.min.y;
}

// Whether `words` are drawn, as a line or as part of a line.
bool says(const std::string& words) {
  const std::vector<DrawnText> texts = drawn_texts();
  return std::any_of(texts.begin(), texts.end(),
                     [&](const DrawnText& text) { return text.text.find(without_blanks(words)) != std::string::npos; });
}

}  // namespace

TEST_CASE(
    "an offered lesson is started, set up and dismissed by one click each; without a click there are no commands") {
  CardRig rig(offered());
  CHECK(says("Hill start"));
  CHECK(says("without rolling back"));
  CHECK_FALSE(says("You fail if you"));
  CoachState failing = offered();
  failing.fail_conditions = "You fail if you stall.";
  rig.show(failing);
  CHECK(says("You fail if you stall."));
  CHECK(rig.frame().empty());
  CHECK(has<BeginLesson>(rig.click("lesson_begin")));
  CHECK_FALSE(has<BeginLesson>(rig.frame()));
  CHECK(has<DismissLesson>(rig.click("lesson_dismiss")));
  CHECK(value(rig.click("mode"), &SetMode::mode) == LessonMode::by_yourself);
  CHECK(value(rig.click("help"), &SetHelp::on) == false);
  CoachState other = offered();
  other.mode = LessonMode::by_yourself;
  other.help_wanted = false;
  rig.show(other);
  CHECK(value(rig.click("mode"), &SetMode::mode) == LessonMode::follow_me);
  CHECK(value(rig.click("help"), &SetHelp::on) == true);
}

TEST_CASE("the card is also shown while the panel is hidden, and covers only the area behind it") {
  for (const bool panel_shown : {true, false}) {
    CAPTURE(panel_shown);
    CardRig rig(driven(), panel_shown);
    const ControlRect leave = rig.rect("lesson_leave"), middle = rig.panel.cabin_area();
    CHECK(rig.panel.covers(0.5 * (leave.min + leave.max)));
    CHECK_FALSE(rig.panel.covers({640.0, 400.0}));
    CHECK(leave.min.x > middle.min.x);
    CHECK(leave.max.x < middle.max.x);
    CHECK(has<LeaveLesson>(rig.click("lesson_leave")));
    rig.show(half_way());
    CHECK_FALSE(rig.panel.covers(0.5 * (leave.min + leave.max)));
    CHECK_FALSE(rig.panel.control_rect("lesson_leave").has_value());
  }
}

TEST_CASE("clicking the card never takes the keyboard from the car") {
  CardRig rig(offered());
  rig.click("mode");
  rig.click("help");
  rig.frame();
  CHECK_FALSE(rig.panel.has_keyboard());
}

TEST_CASE("the card is at the bottom centre and keeps its size in every phase") {
  for (const bool panel_shown : {true, false}) {
    CAPTURE(panel_shown);
    CardRig rig(half_way(), panel_shown);
    rig.input.keys = some_keys();
    const ControlRect all = rig.panel.cabin_area();
    rig.show(offered());
    const ControlRect middle = rig.panel.cabin_area();
    CHECK(middle.max.y < 0.78 * all.max.y);
    CHECK(middle.max.y > 0.60 * all.max.y);
    CHECK(rig.rect("lesson_begin").min.y > middle.max.y);
    CHECK(rig.panel.covers({0.5 * (all.min.x + all.max.x), all.max.y - 20.0}));
    CHECK_FALSE(rig.panel.covers({0.5 * (all.min.x + all.max.x), middle.max.y - 2.0}));
    for (const CoachState& coach : {driven(), over(result_of("hill_start", some_errors())), offered()}) {
      rig.input.coach = coach;
      rig.frame();  // only one frame: the card must have its size at once
      CHECK(rig.panel.cabin_area().max.y <= middle.max.y);
      rig.show(coach);
    }
    const double settled = rig.panel.cabin_area().max.y;  // the card has grown to fit its largest phase
    CHECK(settled > 0.55 * all.max.y);
    for (const CoachState& coach : {driven(), over(result_of("hill_start", some_errors())), offered()}) {
      rig.input.coach = coach;
      rig.frame();
      CHECK(rig.panel.cabin_area().max.y == settled);
    }
    rig.show(half_way());
    CHECK(rig.panel.cabin_area().max.y == all.max.y);
  }
}

TEST_CASE("no prompt of the shipped lessons, with hint and messages, covers more than 40 % of a 1280 x 720 cabin") {
  CardRig rig(driven(), true);
  rig.input.keys = some_keys();
  for (const std::string_view key : kTeachingOrder) {
    const Lesson lesson = shipped_lesson(key);
    for (std::size_t step = 0; step < lesson.steps.size(); ++step) {
      CAPTURE(lesson.key);
      CAPTURE(step);
      CoachState coach = driven(key);
      coach.now.prompt = lesson.steps[step].prompt;
      coach.now.hint = lesson.steps[step].hint;
      rig.show(coach);
      CHECK(rig.panel.cabin_area().max.y > 0.6 * 651.0);
      CHECK(says(coach.now.feedback.back()));
    }
  }
}

TEST_CASE("the button that Enter presses is marked: try again after failing, next lesson after passing") {
  CardRig rig(over(result_of("hill_start", some_errors())));
  rig.input.now.guard = GuardState::running;
  rig.frame();
  rig.frame();
  CHECK(says("Next lesson (Enter)"));
  CHECK_FALSE(says("Try again (Enter)"));
  CoachState failed = over(result_of("hill_start", failing_errors()));
  failed.next = "bite_point";
  rig.show(failed);
  CHECK(says("Try again (Enter)"));
  CHECK_FALSE(says("Next lesson (Enter)"));
  CHECK(value(rig.click("lesson_next"), &OfferLesson::key) == "bite_point");
  rig.show(offered());
  CHECK(says("Start (Enter)"));
  CHECK_FALSE(says("motors"));
}

TEST_CASE("with forces off, starting a lesson switches them on, and a running lesson shows that they are off") {
  CardRig rig(offered());
  for (const GuardState guard : {GuardState::idle, GuardState::damped, GuardState::released}) {
    rig.input.now.guard = guard;
    rig.show(offered());
    CHECK(says("Turn forces on and start (Enter)"));
    const PanelCommands asked = rig.click("lesson_begin");
    CHECK(has<BeginLesson>(asked));
    CHECK(has<Arm>(asked));
    rig.show(driven());
    CHECK(the_text(drawn_texts(), "Forces are off. Press Enter to turn them on.").colour == ui::ink::kBad);
    CHECK_FALSE(has<Arm>(rig.frame()));
  }
  for (const GuardState guard : {GuardState::running, GuardState::ramping}) {
    rig.input.now.guard = guard;
    rig.show(offered());
    const PanelCommands asked = rig.click("lesson_begin");
    CHECK(has<BeginLesson>(asked));
    CHECK_FALSE(has<Arm>(asked));
    rig.show(driven());
    CHECK_FALSE(says("Motors off"));
  }
}

TEST_CASE("the remaining time is shown, and in the warning colour for the last twenty seconds") {
  CoachState coach = driven();
  coach.result.duration = 30.4;
  CardRig rig(coach);
  CHECK_FALSE(says("left"));  // a lesson without a time limit shows no remaining time
  coach.time_limit = 90.0;
  rig.show(coach);
  CHECK(the_text(drawn_texts(), "1:00 left").colour == ui::ink::kSoft);
  coach.result.duration = 70.5;
  rig.show(coach);
  CHECK(the_text(drawn_texts(), "0:20 left").colour == ui::ink::kWarn);
}

TEST_CASE("a lesson that ended early shows that this gives 0 points, in addition to the other deductions") {
  LessonResult result = result_of("hill_start", some_errors());
  result.end = LessonEnd::out_of_time;
  grade_result(shipped_lesson("hill_start"), result);
  CardRig rig(over(result));
  CHECK(says("Time's up (0 points)."));
  CHECK(says("Not passed"));
  CHECK(says("-0.5"));
  result.end = LessonEnd::aborted;
  result.why = "The car rolled back more than a metre.";
  grade_result(shipped_lesson("hill_start"), result);
  rig.show(over(result));
  CHECK(says("The car rolled back more than a metre (0 points)."));
  CHECK_FALSE(says("Time's up"));
  rig.show(over(result_of("hill_start", some_errors())));
  CHECK_FALSE(says("Time's up"));
  CHECK_FALSE(says(": 0"));
  result.end = LessonEnd::left;
  grade_result(shipped_lesson("hill_start"), result);
  rig.show(over(result));
  CHECK(says("Not finished"));
}

TEST_CASE("the end of a run shows each figure with its norm and says that the norm is of simulated drivers") {
  CardRig rig(over(with_norm(result_of("hill_start", some_errors()))));
  CHECK(says("Largest jerk"));
  CHECK(says("120 m/s³"));
  CHECK(says("up to 27 m/s³"));  // 20 times 1.2^1.645
  CHECK(says("0.88 kJ"));
  CHECK(says("The norm is of practised simulated drivers, not of people."));
  CHECK(says("Passed once."));
  rig.show(over(result_of("hill_start", some_errors())));
  CHECK_FALSE(says("Largest jerk"));
  CHECK_FALSE(says("simulated drivers"));
}

TEST_CASE("the keys are listed under goal and prompt, with the starter's key after a stall") {
  for (const CoachState& coach : {offered(), driven()}) {
    CardRig rig(coach);
    CHECK_FALSE(is_drawn("a little throttle"));
    CHECK_FALSE(says("mouse"));
    rig.input.keys = some_keys();
    rig.show(coach);
    const std::vector<DrawnText> texts = drawn_texts();
    double before = 0.0;
    for (const KeyHint& hint : {some_keys()[0], some_keys()[1]}) {
      const PixelBox cap = the_text(texts, hint.key).box, words = the_text(texts, hint.action).box;
      CHECK(cap.min.x > before);
      CHECK(words.min.x > cap.max.x);
      CHECK(words.min.x - cap.max.x < 20.0);
      before = words.max.x;
    }
    CHECK(says("Click to move the lever with the mouse"));
    rig.panel.set_visible(true);
    rig.show(coach);
    CHECK(says("Click the cabin to move the lever with the mouse"));
    rig.panel.set_visible(false);
    rig.input.mouse_moves_lever = true;
    rig.show(coach);
    CHECK(says("The mouse controls the lever (Esc releases the mouse)"));
    CHECK_FALSE(says("Click"));
    rig.input.mouse_moves_lever = false;
    rig.input.is_automatic_hand = true;  // keys and mouse do not move an automatic hand
    rig.show(coach);
    CHECK_FALSE(says("Click"));
    CHECK_FALSE(is_drawn("a little throttle"));
  }
  CardRig rig(driven());
  rig.input.keys = some_keys();
  rig.show(driven());
  CHECK_FALSE(says("Press the clutch"));
  rig.input.car.stalled = true;
  rig.show(driven());
  CHECK(says("Press the clutch, then the starter (E)."));
  rig.input.keys.clear();
  rig.show(driven());
  CHECK(says("Press the clutch, then the starter."));
}

TEST_CASE("with the panel hidden the card shows pedals, engine, handbrake and slope; otherwise the status bar does") {
  CardRig rig(driven());
  rig.input.car.engine_speed = 240.0;
  rig.input.car.pedals.hand_brake = 1.0;
  rig.input.car.slope = std::atan(0.1);
  rig.show(driven());
  for (const char* words : {"clutch", "brake", "throttle", "2292 rpm", "handbrake", "10 % uphill"}) CHECK(says(words));
  const auto blue = [] { return drawn_in(ui::ink::kAccent).size(); };
  const std::size_t up = blue();
  rig.input.car.pedals.clutch = 0.5;
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

TEST_CASE("a guided trial is marked while it is driven, not before; a retention test is marked too") {
  CoachState coach = offered();
  coach.guidance = 0.8;
  CardRig rig(coach);
  CHECK_FALSE(says("guided"));
  coach = driven();
  rig.show(coach);
  CHECK_FALSE(says("guided"));
  CHECK_FALSE(says("test: no guidance"));
  coach.guidance = 0.8;
  rig.show(coach);
  CHECK(says("lever guided, not graded"));
  coach.pedal_help = 0.5;
  rig.show(coach);
  CHECK(says("lever and pedals helped, not graded"));
  coach.guidance = 0.0;
  rig.show(coach);
  CHECK(says("pedals helped, not graded"));
  coach.pedal_help = 0.0;
  coach.retention = true;
  rig.show(coach);
  CHECK(says("test: no guidance"));
  CHECK_FALSE(says("guided"));
}

TEST_CASE("prompt, hint and step are the coach's, and the progress bar has a part for each completed step") {
  CoachState coach = driven("reverse");
  coach.now.feedback.clear();
  CardRig rig(coach);
  CHECK(says(coach.now.prompt));
  CHECK(says("step 3 of 7"));
  const auto parts = [](ImU32 colour) {  // [px] right edge of the progress bar's last part in this colour
    std::vector<double> edges;
    for (const glm::dvec2 at : drawn_in(colour)) edges.push_back(at.x);
    return edges.empty() ? 0.0 : *std::max_element(edges.begin(), edges.end());
  };
  const double two_done = parts(ui::ink::kGood);
  coach.now.step = 5;
  rig.show(coach);
  CHECK(parts(ui::ink::kGood) > two_done + 50.0);
  CHECK(says("step 6 of 7"));
}

TEST_CASE("the newest message is large for some seconds, then as small as the earlier ones") {
  const std::string first = "The lever moved 0.12 s before the clutch was down.", second = "The engine stalled.";
  CoachState coach = driven();
  coach.now.hint.clear();
  coach.now.feedback = {first};
  CardRig rig(coach);
  const double large = height_of(first);
  rig.screen.seconds = 1.0f;
  for (int i = 0; i < 8; ++i) rig.frame();
  const double small = height_of(first);
  CHECK(large > 1.15 * small);
  coach.now.feedback = {first, second};
  rig.input.coach = coach;
  rig.frame();
  rig.frame();
  CHECK(height_of(first) == doctest::Approx(small));
  CHECK(the_text(drawn_texts(), second).box.max.y < the_text(drawn_texts(), first).box.min.y);
  const double large_second = height_of(second);
  for (int i = 0; i < 8; ++i) rig.frame();
  CHECK(large_second > 1.15 * height_of(second));
}

TEST_CASE(
    "from a phase's second frame on the card has all its buttons and keys; an open card has them from the first") {
  for (const bool panel_shown : {true, false}) {
    CAPTURE(panel_shown);
    for (const CoachState& coach : {offered(), over(result_of("hill_start", failing_errors()))}) {
      CardRig rig(half_way(), panel_shown);
      rig.input.keys = some_keys();
      rig.input.coach = coach;
      rig.frame();
      rig.frame();  // ImGui draws a new window only in its second frame
      const bool is_over = coach.phase == LessonPhase::over;
      const ControlRect button = rig.rect(is_over ? "lesson_again" : "lesson_begin");
      const double foot = panel_shown ? rig.rect("stop").min.y : 720.0;
      CHECK(button.max.y < foot);
      CHECK(says(is_over ? "retry" : "(Enter)"));
    }
    CardRig rig(driven(), panel_shown);  // the card is already open while the lesson is driven
    rig.input.coach = over(result_of("hill_start", failing_errors()));
    rig.frame();
    CHECK(rig.panel.control_rect("lesson_again").has_value());
    CHECK(rig.panel.control_rect("lesson_dismiss").has_value());
    CHECK(says("retry"));
    CHECK(says("Close"));
    CHECK(says("Repeat"));
    CHECK(says("Not passed"));
  }
}

TEST_CASE("while the instructor holds the car, the card says so and how to take over") {
  const LessonResult passed = result_of("hill_start", some_errors());
  for (const bool is_over : {true, false}) {
    CardRig rig(is_over ? over(passed) : offered());
    CHECK_FALSE(says("teacher"));
    rig.input.instructor_holds_pedals = true;
    rig.frame();
    rig.frame();
    CHECK(says("The instructor is holding the clutch and brake"));
    CHECK(says(is_over ? "Press \"Close\" to take over" : "Press \"Not now\" to take over"));
  }
}

TEST_CASE("the card of a trial that can no longer be passed says so once, and what to do") {
  CardRig rig(driven());
  CHECK_FALSE(says("no longer pass this attempt"));
  rig.input.is_unpassable = true;
  rig.show(driven());
  const std::vector<DrawnText> texts = drawn_texts();
  CHECK(std::count_if(texts.begin(), texts.end(), [](const DrawnText& text) {
          return text.text.find(without_blanks("no longer pass this attempt")) != std::string::npos;
        }) == 1);
  CHECK(says("Keep practising"));
  rig.show(over(result_of("hill_start", failing_errors())));
  CHECK_FALSE(says("no longer pass this attempt"));
}

TEST_CASE("deductions and grade add up to ten, and each deduction names its error and time") {
  CardRig rig(over(result_of("hill_start", some_errors())));
  double deducted = 0.0;
  int lines = 0;
  for (const DrawnText& text : drawn_texts()) {
    if (text.text.front() != '-' || text.text.size() != 4) continue;
    deducted -= std::atof(text.text.c_str());
    ++lines;
  }
  CHECK(lines == 2);
  CHECK(10.0 - deducted == doctest::Approx(9.0));
  const DrawnText grade = the_text(drawn_texts(), "9.0");
  for (const DrawnText& text : drawn_texts())
    CHECK(text.box.max.y - text.box.min.y <= grade.box.max.y - grade.box.min.y);
  CHECK(right_of("7.9 s") == std::vector<std::string>{without_blanks("The gears ground (12.4 J)."), "-0.5"});
  CHECK(says("Passed"));
  CHECK_FALSE(says("wrong slot"));  // this error costs no points, so it is not listed
}

TEST_CASE("after a lesson one click restarts it or offers the next lesson; a guided lesson has no grade") {
  CardRig rig(over(result_of("hill_start", some_errors())));
  CHECK(has<BeginLesson>(rig.click("lesson_again")));
  CHECK(value(rig.click("lesson_next"), &OfferLesson::key) == "emergency_stop");
  CHECK(has<DismissLesson>(rig.click("lesson_dismiss")));
  CHECK(says("Emergency stop"));
  rig.show(over(result_of("hill_start", failing_errors())));
  CHECK(says("Not passed"));
  CHECK(says("The engine stalled: it fell from 592 rpm within a second."));
  CHECK_FALSE(rig.panel.control_rect("lesson_next").has_value());  // no button: the next lesson is this one
  rig.show(over(result_of("hill_start", some_errors(), true)));
  CHECK(says("graded"));
  CHECK_FALSE(says("Passed"));
  CHECK_FALSE(says("0.0"));
  CHECK_FALSE(says("10.0"));
  CHECK_FALSE(says("-0.5"));
}
