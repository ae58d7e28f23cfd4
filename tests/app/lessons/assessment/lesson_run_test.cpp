// Tests the state machine of a lesson: prompts, steps, hints, aborts, time limits, feedback, guidance, and
// repeatability.
#include "app/lessons/assessment/lesson_run.h"

#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "app/lessons/assessment/drive_condition.h"
#include "app/lessons/assessment/grade.h"
#include "app/lessons/assessment/lever_path_text.h"
#include "tests/app/lessons/assessment/constructed_shift.h"

using namespace gearshift::haptics;
using namespace gearshift::lessons;
using namespace gearshift::test;
using namespace gearshift::vehicle;

namespace {

DriveCondition in_gear(int gear) {
  DriveCondition c;
  c.gear = gear;
  return c;
}

DriveCondition clutch_above(double value) {
  DriveCondition c;
  c.clutch_above = value;
  return c;
}

// A lesson whose three steps match the constructed shift: clutch down, third gear, clutch up.
Lesson shift_lesson() {
  Lesson lesson;
  lesson.key = lesson.task = "shift";
  lesson.goal = "Shift to third.";
  lesson.time_limit = 20.0;
  lesson.fails_on = {ErrorKind::stall};
  lesson.counted = {ErrorKind::clutch_early, ErrorKind::over_push, ErrorKind::wrong_gear};
  DriveCondition up = in_gear(3);
  up.clutch_below = 0.2;
  up.clutch_locked = true;
  lesson.steps = {{"Clutch down.", "All the way.", clutch_above(0.8), kNeutralGear, 2.0},
                  {"Lever to 3.", "Straight ahead.", in_gear(3), 3, 2.0},
                  {"Clutch up.", "Slowly.", up, 3, 2.0}};
  return lesson;
}

// The last view of a run, its result and its shifts.
class Outcome {
 public:
  explicit Outcome(LessonRun& run) : view_(run.view()), result_(run.result()), shifts_(run.drain_shifts()) {
    CHECK(run.drain_shifts().empty());
  }
  const LessonView& view() const { return view_; }
  const LessonResult& result() const { return result_; }
  std::size_t shifts() const { return shifts_.size(); }

 private:
  LessonView view_;
  LessonResult result_;
  std::vector<ShiftRecord> shifts_;
};

struct Driven {
  ConstructedShift shift;
  Lesson lesson = shift_lesson();
  LessonRunConfig config;
  std::function<void(LessonRun&, double)> each = [](LessonRun&, double) {};

  Outcome run() const {
    LessonRun run(lesson, shift.car, shift.gate, config);
    for (const DriveSample& s : shift.samples()) {
      run.add(s);
      each(run, s.time() - 100.0);
    }
    return Outcome(run);
  }
};

}  // namespace

TEST_CASE("steps are prompted in order if the mode asks for it, and the lesson ends with the shift") {
  std::vector<std::pair<std::string, double>> prompts;
  double done = 0.0;
  Driven driven;
  driven.each = [&](LessonRun& run, double t) {
    if (prompts.empty() || prompts.back().first != run.view().prompt) prompts.emplace_back(run.view().prompt, t);
    if (run.is_over() && done == 0.0) done = t;
  };
  const Outcome run = driven.run();
  REQUIRE(prompts.size() == 4);
  CHECK(prompts[0].first == "Clutch down.");
  CHECK(prompts[1].first == "Lever to 3.");
  CHECK(prompts[1].second == doctest::Approx(0.081).epsilon(0.02));
  CHECK(prompts[2].first == "Clutch up.");
  CHECK(prompts[3].first == "Shift to third.");
  CHECK(prompts[3].second == doctest::Approx(0.761).epsilon(0.01));
  CHECK(done == doctest::Approx(0.85).epsilon(0.01));  // the shift's record is complete
  CHECK(run.result().end == LessonEnd::done);
  CHECK(run.result().passed);
  CHECK(run.result().grade == 10.0);
  CHECK(run.result().shifts.size() == 1);
  CHECK(run.shifts() == 1);
  CHECK(run.result().begin == doctest::Approx(99.0));
  CHECK(run.result().duration == doctest::Approx(1.0 + done).epsilon(1e-6));

  Driven by_yourself;
  by_yourself.config.mode = LessonMode::by_yourself;
  by_yourself.each = [](LessonRun& r, double) { CHECK(r.view().prompt == "Shift to third."); };
  CHECK(by_yourself.run().result().passed);
}

TEST_CASE("the guided gear is that of the current step") {
  Driven driven;
  driven.each = [](LessonRun& run, double t) {
    if (t < 0.07) CHECK(run.view().guided_gear == kNeutralGear);
    if (t > 0.1 && t < 0.75) CHECK(run.view().guided_gear == 3);
    if (run.is_over()) CHECK(run.view().guided_gear == kNeutralGear);
  };
  driven.run();
}

TEST_CASE("a hint comes after the step's patience and ends with the step; bandwidth and summary show no hints") {
  for (const HintStyle style : {HintStyle::prescriptive, HintStyle::bandwidth, HintStyle::summary}) {
    Driven driven;
    driven.config.hints = style;
    driven.shift.from = -4.0;
    const bool prescriptive = style == HintStyle::prescriptive;
    driven.each = [&](LessonRun& run, double t) {
      if (t < -2.01) CHECK(run.view().hint.empty());
      if (t > -1.99 && t < 0.0) CHECK(run.view().hint == (prescriptive ? "All the way." : ""));
      if (t > 0.1) CHECK(run.view().hint.empty());
    };
    driven.run();
  }
}

TEST_CASE("a driver who continues in the wrong gear gets a hint, with or without prompts, in every hint style") {
  Driven driven;
  driven.lesson.steps[1] = {"Lever to 4.", "", in_gear(4), 4, 2.0};
  driven.lesson.steps[2].until.gear = 4;
  driven.config = {LessonMode::by_yourself, 0.0, HintStyle::summary};
  driven.shift.to = 6.0;
  driven.each = [](LessonRun& run, double t) {  // third, the wrong gear, engages at 0.49 s; the hint comes 3 s later
    if (t < 3.48) CHECK(run.view().hint.empty());
    if (t > 3.50) CHECK(run.view().hint == "Shift into fourth to continue.");
  };
  driven.run();
}

TEST_CASE("a lever step without its own hint describes the lever's path in this gate") {
  Driven driven;
  driven.lesson.start.gear = 2;
  driven.lesson.steps.erase(driven.lesson.steps.begin());
  driven.lesson.steps[0].hint.clear();
  driven.shift.from = -4.0;
  driven.each = [](LessonRun& run, double t) {
    if (t > -1.9 && t < 0.0) CHECK(run.view().hint == describe_lever_path(known_gate(), 2, 3));
  };
  driven.run();
}

TEST_CASE("errors are reported as they happen, or with summary hints at the end; unchecked kinds are silent notes") {
  const auto modify = [](DriveSample& s, double t) {
    if (t > 0.3 && t < 0.35) s.lever.f_h = {70.0, 0.0};
    // The throttle is released after the clutch is down. The lesson does not check the order of the steps, so the error
    // is only a note.
    s.car.pedals.throttle = t < 0.29 ? 0.3 : 0.0;
  };
  Driven driven;
  driven.shift.modify = modify;
  double report_time = 0.0;
  driven.each = [&](LessonRun& run, double t) {
    if (report_time == 0.0 && !run.view().feedback.empty()) report_time = t;
  };
  const Outcome run = driven.run();
  // The push ends at 0.35 s. It counts as ended after a pause of 0.3 s, so it is reported at 0.65 s.
  CHECK(report_time == doctest::Approx(0.65).epsilon(0.02));
  CHECK(run.view().feedback == std::vector<std::string>{"You pushed the lever too hard (70 N)."});
  REQUIRE(run.result().errors.size() == 2);
  CHECK(run.result().errors[1].kind == ErrorKind::step_order);
  CHECK(run.result().errors[1].severity == Severity::note);
  CHECK(run.result().errors[0].shift == 0);
  CHECK(run.result().grade == 9.5);

  Driven silent;
  silent.shift.modify = modify;
  silent.config.hints = HintStyle::summary;
  silent.each = [](LessonRun& r, double) { CHECK(r.view().feedback.empty() == !r.is_over()); };
  CHECK(silent.run().view().feedback.size() == 1);
}

TEST_CASE("an error belongs to the shift in which it happened, even if it is detected after the shift's record") {
  Driven driven;
  driven.lesson.counted = {ErrorKind::clutch_dump};
  driven.lesson.steps[2].until.held = 1.0;
  driven.shift.modify = [](DriveSample& s, double t) {
    if (t > 0.6) s.car.pedals.clutch = ConstructedShift::line(t, 0.6, 1.0, 0.8, 0.0);
    if (t > 0.74) s.car.pedals.clutch = 0.0;
    s.car.clutch_locked = t < 0.075 || t > 0.68;
    s.car.slip_power = t > 0.65 && t < 0.68 ? 20e3 : 0.0;
  };
  const Outcome run = driven.run();
  REQUIRE(run.result().errors.size() == 1);
  CHECK(run.result().errors[0].kind == ErrorKind::clutch_dump);
  CHECK(run.result().errors[0].shift == 0);
}

TEST_CASE("a gear that was not requested is reported at once") {
  Driven driven;
  driven.lesson.steps[1].until = in_gear(4);
  driven.lesson.steps[1].gear = 4;
  driven.lesson.steps[2].until.gear = 4;
  const Outcome run = driven.run();
  REQUIRE(run.result().errors.size() == 1);
  CHECK(run.result().errors[0].kind == ErrorKind::wrong_gear);
  CHECK(run.view().feedback == std::vector<std::string>{"You engaged third instead of fourth."});
  CHECK(run.view().step == 1);
}

TEST_CASE("a step that may be skipped is done when a later step's condition becomes true; other steps are not") {
  Driven driven;
  driven.lesson.steps[0].until = DriveCondition();
  driven.lesson.steps[0].until.throttle_above = 0.9;  // this never happens
  CHECK(driven.run().view().step == 0);
  driven.lesson.steps[0].may_be_skipped = true;
  CHECK(driven.run().result().end == LessonEnd::done);
  Driven two;  // two steps in a row are skipped if both may be skipped
  two.lesson.steps[0].until = driven.lesson.steps[0].until;
  two.lesson.steps[1].until = driven.lesson.steps[0].until;
  two.lesson.steps[0].may_be_skipped = true;
  CHECK(two.run().view().step == 0);
  two.lesson.steps[1].may_be_skipped = true;
  CHECK(two.run().result().end == LessonEnd::done);
  Driven stays;
  stays.lesson.steps[0].may_be_skipped = true;
  stays.lesson.steps[0].until.clutch_above = {};
  stays.lesson.steps[0].until.throttle_above = 0.9;
  stays.lesson.steps[1].until = DriveCondition();
  // This condition is true from the start, so no step is skipped: only a condition that becomes true skips steps.
  stays.lesson.steps[1].until.speed_above = 1.0;
  CHECK(stays.run().view().step == 0);
}

TEST_CASE("`held`: a condition must be true without interruption for that time") {
  const auto step_done_at = [](double held, double gap) {
    Driven driven;
    driven.lesson.steps.resize(1);
    driven.lesson.steps[0].until.held = held;
    driven.shift.modify = [gap](DriveSample& s, double t) {
      if (t > 0.3 && t < 0.3 + gap) s.car.pedals.clutch = 0.79;
    };
    double at = 0.0;
    driven.each = [&](LessonRun& run, double t) {
      if (at == 0.0 && run.view().step == 1) at = t;
    };
    driven.run();
    return at;
  };
  CHECK(step_done_at(0.3, 0.0) == doctest::Approx(0.081 + 0.3).epsilon(0.01));
  CHECK(step_done_at(0.3, 0.01) == doctest::Approx(0.31 + 0.3).epsilon(0.01));
  CHECK(step_done_at(0.9, 0.0) == 0.0);
}

TEST_CASE("distance is measured from the lesson's start, rolling back from the step's start") {
  Driven driven;
  driven.lesson.steps.resize(1);
  driven.lesson.steps[0].until = DriveCondition();
  driven.lesson.steps[0].until.distance_above = 12.0;  // [m] reached at 0 s: 12 m/s from -1 s on
  double at = 0.0;
  driven.each = [&](LessonRun& run, double t) {
    if (at == 0.0 && run.view().step == 1) at = t;
  };
  driven.run();
  CHECK(at == doctest::Approx(0.001).epsilon(0.01));

  Driven back;
  DriveCondition rolled;
  rolled.rolled_back_above = 1.0;
  back.lesson.aborts = {{rolled, "The car rolled back more than a metre."}};
  back.shift.modify = [](DriveSample& s, double t) { s.car.distance = t < 0.2 ? 5.0 + t : 5.2 - 5.0 * (t - 0.2); };
  const Outcome run = back.run();
  CHECK(run.result().end == LessonEnd::aborted);
  CHECK(run.result().why == "The car rolled back more than a metre.");
  CHECK_FALSE(run.result().passed);
}

TEST_CASE("a run that is out of time, left or incomplete is not passed, and nothing counts after its end") {
  Driven slow;
  slow.lesson.time_limit = 1.5;
  slow.shift.modify = [](DriveSample& s, double) { s.car.pedals.clutch = 0.0; };
  const Outcome run = slow.run();
  CHECK(run.result().end == LessonEnd::out_of_time);
  CHECK(run.result().duration == doctest::Approx(1.5).epsilon(0.001));

  Driven left;
  left.each = [](LessonRun& r, double t) {
    if (t > 0.2) r.leave();
  };
  CHECK(left.run().result().end == LessonEnd::left);
  CHECK(left.run().result().why == "You left the lesson.");

  Driven torn;
  torn.each = [](LessonRun& r, double t) {
    if (t > 0.2 && t < 0.2015) r.mark_incomplete();
  };
  const Outcome lost = torn.run();
  CHECK(lost.result().end == LessonEnd::done);
  CHECK_FALSE(lost.result().passed);
  CHECK(points_lost(lost.result()) == 0.0);
}

TEST_CASE("a step that took too long is an error with its own sentence; the value is the step's duration") {
  const auto within = [](double seconds, std::size_t step = 1) {
    Driven driven;
    driven.lesson.counted.push_back(ErrorKind::slow_step);
    driven.lesson.steps[step].within = seconds;
    return driven.run();
  };
  // In the constructed shift, the clutch passes 0.8 at 0.081 s, third engages at 0.491 s, and the clutch is up at 0.761
  // s. The lesson begins at -1 s.
  CHECK(within(0.42).result().errors.empty());
  const Outcome slow = within(0.40);
  REQUIRE(slow.result().errors.size() == 1);
  const DrivingError& error = slow.result().errors[0];
  CHECK(error.kind == ErrorKind::slow_step);
  CHECK(error.severity == Severity::minor);
  CHECK(error.duration == doctest::Approx(0.41).epsilon(0.01));
  CHECK(error.time == doctest::Approx(100.491).epsilon(1e-5));
  CHECK(error.shift == 0);  // the error belongs to the first shift
  CHECK(error_sentence(error) == "You took 0.41 s for this step (limit 0.40 s): \"Lever to 3.\"");
  CHECK(slow.result().grade == 9.5);
  REQUIRE(slow.view().feedback.size() == 1);
  CHECK(within(0.20).result().errors[0].severity == Severity::severe);  // 0.41 s is more than twice this limit
  CHECK(within(1.0, 0).result().errors[0].duration == doctest::Approx(1.081).epsilon(0.01));
}

TEST_CASE("a step that took far too long fails a lesson that fails on slow steps") {
  for (const double fails_after : {0.42, 0.40}) {
    Driven driven;
    driven.lesson.fails_on.push_back(ErrorKind::slow_step);
    driven.lesson.steps[1].within = 0.3;  // [s] too short: this step takes 0.41 s
    driven.lesson.steps[1].fails_after = fails_after;
    const LessonResult result = driven.run().result();
    CHECK(points_lost(result) == 0.5);
    CHECK(result.passed == (fails_after > 0.41));
    CHECK(result.passed == (result.grade >= driven.lesson.pass_grade));
    if (!result.passed) CHECK(result.why == "You took 0.41 s for this step (limit 0.30 s): \"Lever to 3.\"");
  }
}

TEST_CASE("a condition may require clutch torque and the shift light") {
  DriveSample sample;
  sample.car.clutch_torque = 40.0;
  DriveCondition carries, lit;
  carries.clutch_torque_above = 39.0;
  lit.shift_light = true;
  CHECK(holds(carries, sample, {}));
  CHECK_FALSE(holds(lit, sample, {}));
  sample.car.clutch_torque = -40.0;  // the engine brakes the car
  sample.car.shift_advice = -1;      // the light advises a downshift
  CHECK_FALSE(holds(carries, sample, {}));
  CHECK_FALSE(holds(lit, sample, {}));
  sample.car.shift_advice = 1;
  CHECK(holds(lit, sample, {}));
}

TEST_CASE("a skipped step lasts until the next step is done, which itself takes no time") {
  Driven driven;
  driven.lesson.counted.push_back(ErrorKind::slow_step);
  driven.lesson.steps[1].until.throttle_above = 0.99;  // this never happens
  driven.lesson.steps[1].may_be_skipped = true;
  driven.lesson.steps[1].within = 0.6;
  driven.lesson.steps[2].within = 0.1;
  const Outcome run = driven.run();
  CHECK(run.result().end == LessonEnd::done);
  REQUIRE(run.result().errors.size() == 1);
  CHECK(run.result().errors[0].step == "Lever to 3.");
  CHECK(run.result().errors[0].duration == doctest::Approx(0.68).epsilon(0.02));
}

TEST_CASE("a run that ends during an overdue step has that error, but not during a step that is still in time") {
  for (const double left_at : {0.2, 0.4}) {
    Driven driven;
    driven.lesson.counted.push_back(ErrorKind::slow_step);
    driven.lesson.steps[1].within = 0.2;  // [s] the step begins at 0.081 s and is overdue from 0.281 s on
    driven.each = [=](LessonRun& r, double t) {
      if (t >= left_at) r.leave();
    };
    const LessonResult result = driven.run().result();
    CHECK(result.end == LessonEnd::left);
    REQUIRE(result.errors.size() == (left_at > 0.3 ? 1 : 0));
    if (left_at > 0.3) CHECK(result.errors[0].duration == doctest::Approx(0.32).epsilon(0.02));
  }
}

TEST_CASE("without prompts only the goal is shown, except during a step that is a call to react") {
  Driven driven;
  driven.config.mode = LessonMode::by_yourself;
  driven.lesson.steps[1].call = true;
  std::vector<std::string> prompts;
  driven.each = [&](LessonRun& r, double) {
    if (prompts.empty() || prompts.back() != r.view().prompt) prompts.push_back(r.view().prompt);
  };
  driven.run();
  CHECK(prompts == std::vector<std::string>{"Shift to third.", "Lever to 3.", "Shift to third."});
}

TEST_CASE("a lesson is not passed if an error fails it") {
  Driven driven;
  driven.shift.modify = [](DriveSample& s, double t) { s.car.running = t < 0.3 || t > 0.31; };
  const Outcome run = driven.run();
  CHECK(run.result().end == LessonEnd::done);
  CHECK_FALSE(run.result().passed);
  CHECK(run.result().why.find("The engine stalled") == 0);
}

TEST_CASE("guided trials are never graded, whether guidance was planned or appears in the controls") {
  Driven planned;
  planned.config.guidance = 0.4;
  CHECK(planned.run().result().guided);
  CHECK_FALSE(planned.run().result().passed);
  CHECK(planned.run().result().grade == 0.0);
  CHECK(run_error(planned.run().result()) == 0.0);
  Driven led;
  led.shift.modify = [](DriveSample& s, double t) { s.controls.guidance = t > 0.3 && t < 0.303 ? 0.1 : 0.0; };
  CHECK(led.run().result().guided);
  CHECK_FALSE(led.run().result().passed);
}

TEST_CASE("clutch heat is that during the lesson") {
  Driven driven;
  driven.shift.modify = [](DriveSample& s, double t) { s.car.slip_energy = 1000.0 + 100.0 * (t + 1.0); };
  const LessonResult result = driven.run().result();
  CHECK(result.slip_energy == doctest::Approx(100.0 * result.duration).epsilon(1e-6));
}

TEST_CASE("a shift that is in progress at the last step may finish within three seconds") {
  Driven driven;
  driven.lesson.steps.resize(2);  // without its last step, the lesson is done when third is engaged
  CHECK(driven.run().result().shifts.size() == 1);
  Driven never;
  never.lesson.steps.resize(2);
  never.shift.to = 6.0;
  never.shift.modify = [](DriveSample& s, double t) { s.car.pedals.clutch = t > 0.1 ? 1.0 : s.car.pedals.clutch; };
  const Outcome run = never.run();
  CHECK(run.result().end == LessonEnd::done);
  CHECK(run.result().duration == doctest::Approx(1.0 + 0.491 + 3.0).epsilon(0.01));
  REQUIRE(run.result().shifts.size() == 1);  // the unfinished shift is recorded
  CHECK(run.result().shifts[0].to == 3);
  CHECK(run.result().shifts[0].clutch_time > 3.0);
}

TEST_CASE("equal drives give equal results") {
  const auto once = [] {
    Driven driven;
    driven.shift.modify = [](DriveSample& s, double t) {
      s.lever.f_h = {30.0 * std::sin(40.0 * t), 65.0 * std::sin(9.0 * t)};
    };
    return driven.run();
  };
  const Outcome first = once(), second = once();
  const LessonResult &a = first.result(), &b = second.result();
  CHECK(a.grade == b.grade);
  REQUIRE(a.errors.size() == b.errors.size());
  CHECK_FALSE(a.errors.empty());
  for (std::size_t i = 0; i < a.errors.size(); ++i) CHECK(error_sentence(a.errors[i]) == error_sentence(b.errors[i]));
  REQUIRE(a.shifts.size() == 1);
  CHECK(a.shifts[0].impulse == b.shifts[0].impulse);
  CHECK(a.shifts[0].jerk_peak == b.shifts[0].jerk_peak);
}

TEST_CASE("a lesson for a gear that the gate lacks is rejected") {
  const ConstructedShift shift;
  const auto refused = [&](auto change) {
    Lesson lesson = shift_lesson();
    change(lesson);
    CHECK_THROWS_AS(LessonRun(lesson, shift.car, shift.gate, {}), std::invalid_argument);
  };
  refused([](Lesson& l) { l.steps[1].gear = 6; });
  refused([](Lesson& l) { l.steps[1].until.gear = 6; });
  refused([](Lesson& l) { l.start.gear = 7; });
  refused([](Lesson& l) { l.aborts = {{in_gear(8), "No."}}; });
  CHECK_NOTHROW(LessonRun(shift_lesson(), shift.car, shift.gate, {}));
}

TEST_CASE("a lesson that needs an engine beyond the car's red line is rejected in one sentence") {
  const ConstructedShift shift;
  const auto refusal = [&](auto change) -> std::string {
    Lesson lesson = shift_lesson();
    lesson.key = "fast";
    change(lesson);
    CarSpec car = shift.car;
    car.name = "slow";
    car.engine.red_line = 4750.0 * kTurnPerMinute;
    try {
      LessonRun(lesson, car, shift.gate, {});
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return {};
  };
  const auto rpm = [](double value) { return value * kTurnPerMinute; };
  CHECK(refusal([&](Lesson& l) { l.steps[1].until.engine_above = rpm(6000.0); }) ==
        "lesson fast asks in step 2 for 6000 rpm, but the red line of the car \"slow\" is at 4750; choose another car");
  CHECK(refusal([&](Lesson& l) {
          l.shift_from = rpm(5000.0), l.shift_to = rpm(6000.0);
        }).starts_with("lesson fast asks to shift up from 5000 rpm"));
  CHECK(refusal([](Lesson& l) { l.start.gear = 1, l.start.speed = 30.0; }).starts_with("lesson fast starts at "));
  CHECK(refusal([&](Lesson& l) { l.steps[1].until.engine_above = rpm(4000.0); }).empty());
  // At 25 m/s the engine would turn 17 rad/m in third: 1.29 * 4 / 0.303, that is 4066 rpm; in second 6146 rpm.
  const auto at_speed = [](int gear) {
    return [gear](Lesson& l) { l.steps[1].until = in_gear(gear), l.steps[1].until.speed_above = 25.0; };
  };
  CHECK(refusal(at_speed(3)).empty());
  CHECK(refusal(at_speed(2)) ==
        "lesson fast asks in step 2 for 6146 rpm, but the red line of the car \"slow\" is at 4750; choose another car");
}

TEST_CASE("a lesson that needs more speed than the car has is rejected in the car's unit; prompts have its unit, too") {
  const ConstructedShift shift;
  CarSpec car = read_car(GEARSHIFT_ASSETS "/cars/hatchback.toml");  // 181 km/h
  Lesson lesson = shift_lesson();
  lesson.key = "fast";
  lesson.steps[0].prompt = "Reach 200 km/h.";
  lesson.steps[0].until = {};
  lesson.steps[0].until.speed_above = 200.0 / 3.6;
  const std::string rest = "; choose another car";
  const auto refusal = [&] {
    try {
      LessonRun(lesson, car, shift.gate, {});
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(refusal() == "lesson fast asks in step 1 for 200 km/h, but the car \"hatchback\" reaches 181 km/h" + rest);
  car.speed_unit = SpeedUnit::mph;
  CHECK(refusal() == "lesson fast asks in step 1 for 124 mph, but the car \"hatchback\" reaches 112 mph" + rest);
  lesson.steps[0].until.speed_above = 100.0 / 3.6;
  lesson.steps[0].prompt = "Reach 100 km/h.";
  CHECK(LessonRun(lesson, car, shift.gate, {}).view().prompt == "Reach 62 mph.");
}
