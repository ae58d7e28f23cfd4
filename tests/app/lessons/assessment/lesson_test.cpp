// Tests that lesson files are read, and that invalid files are rejected in one sentence with file, line and reason.
#include "app/lessons/assessment/lesson.h"

#include <cmath>
#include <filesystem>
#include <set>
#include <string>

#include <doctest/doctest.h>

#include "haptics/files/file_error.h"
#include "haptics/files/printable.h"

using namespace gearshift::haptics;
using namespace gearshift::lessons;
using namespace gearshift::vehicle;

namespace {

struct Hostile {
  const char* file;
  const char* sentence;  // the expected message, without the file name
};

constexpr Hostile kHostile[] = {
    {"abort_at_once", ":16: the condition is empty and would be met at once"},
    {"abort_without_words", ":14: says is missing: it must be text in quotes"},
    {"early_without_a_band", ":1: shift_from_rpm is missing, but this lesson checks early_shift"},
    {"empty", ":1: title is missing: it must be text in quotes"},
    {"empty_faults", ":18: [faults] must name at least one error, or the lesson's grade would mean nothing"},
    {"empty_goal", ":2: goal = \"\": must not be empty"},
    {"engine_never",
     ":12: engine_above_rpm = 3000: could never be met; the value must be smaller than engine_below_rpm"},
    {"fault_forgiven", ":19: stall = \"forgiven\": must be one of counts, fails"},
    {"fails_before_it_is_slow", ":13: fails_after_s = 4: must be at least within_s, which this step must also set"},
    {"fails_without_a_time", ":12: fails_after_s = 4: must be at least within_s, which this step must also set"},
    {"flag_as_text", ":12: running = \"yes\": must be true or false"},
    {"gear_as_a_number", ":12: gear = 2: must be text in quotes"},
    {"gear_ten", ":12: gear = \"10\": must be one of R, N, 1, 2, 3, 4, 5, 6, 7, 8, 9"},
    {"guided_astray", ":12: guide_to = \"3\": leads away from gear 2, which this step waits for"},
    {"late_without_a_band", ":1: shift_to_rpm is missing, but this lesson checks late_shift"},
    {"no_faults", ":1: faults is missing: it must be a table, [faults]"},
    {"no_steps", ":1: step is missing: write one [[step]] for each action"},
    {"no_task", ":1: task is missing: it must be text in quotes"},
    {"no_title", ":1: title is missing: it must be text in quotes"},
    {"not_toml", ":2: not valid TOML: "},
    {"over_before_it_is_done", ":4: time_limit_s = 60: must be longer than the sum of held_s over all steps"},
    {"pass_grade_eleven", ":4: pass_grade = 11: must be between 1 and 10"},
    {"pass_grade_zero", ":4: pass_grade = 0: must be between 1 and 10"},
    {"patience_of_a_saint", ":12: patience_s = 3600: must be between 1 and 60"},
    {"pedal_beyond", ":12: clutch_above = 1.5: must be between 0 and 1"},
    {"reverse_at_speed", ":8: speed_km_per_h = 10: must be 0 in gear R"},
    {"stalls_at_once",
     ":8: gear = \"1\": must be \"N\" if the car stands and the engine runs, or it would stall at once"},
    {"rolling_engine_off", ":8: speed_km_per_h = 10: must be 0 if the engine is not running"},
    {"shift_band_of_nobody", ":5: shift_band = \"tractor\": must be one of car"},
    {"shift_band_upside_down", ":4: shift_from_rpm = 3000: must be smaller than shift_to_rpm"},
    {"shift_to_neutral", ":11: shift_to = \"N\": must be a gear; to shift into N, write a step that waits for N"},
    {"shift_to_with_a_prompt", ":12: prompt is not a known key; known keys: shift_to"},
    {"slope_of_a_wall", ":7: slope_percent = 100: must be between -30 and 30"},
    {"speed_never",
     ":12: speed_above_km_per_h = 30: could never be met; the value must be smaller than speed_below_km_per_h"},
    {"speed_without_unit", ":12: speed_above is not a known key; known keys: gear"},
    {"start_is_text", ":6: start = \"1\": must be a table: write [start]"},
    {"step_is_a_table", ":10: step = (a table): must be a list of tables: write each as [[step]]"},
    {"step_that_holds_at_once", ":12: the condition is empty and would be met at once"},
    {"step_without_prompt", ":10: prompt is missing: it must be text in quotes"},
    {"step_without_until", ":10: until is missing: it must be a table, [until]"},
    {"time_limit_nan", ":4: time_limit_s = nan: must be between 10 and 1800"},
    {"time_limit_zero", ":4: time_limit_s = 0: must be between 10 and 1800"},
    {"title_with_escape", ":1: title = \"?[2JHostile\": must be one line without control characters"},
    {"too_many_steps",
     ":10: step = (a list): has more than 64 steps (each shift_to counts as three); split the lesson in two"},
    {"two_shift_bands",
     ":5: shift_from_rpm = 1500: cannot be combined with shift_band, which uses the car's own limits"},
    {"unknown_fault", ":19: tyre_blown is not a known key; known keys: stall"},
    {"unknown_key", ":4: difficulty is not a known key; known keys: title"},
    {"unknown_table", ":18: music is not a known key; known keys: title"},
    {"slow_step_of_none", ":19: slow_step = \"counts\": no step sets within_s, so no step could be slow"},
    {"within_its_own_hold",
     ":12: within_s = 2: must be longer than held_s of the same step, or no attempt could be in time"},
    {"within_no_time", ":12: within_s = 0: must be between 0.1 and 120"},
    {"within_that_nobody_judges", ":19: slow_step is missing, but a step sets within_s"},
    {"wrong_gear_of_none", ":19: wrong_gear = \"counts\": no step asks for a gear, so no gear could be wrong"},
};

constexpr const char* kFolder = GEARSHIFT_TEST_DATA "/hostile_lessons";

std::string refusal(const std::filesystem::path& file) {
  try {
    read_lesson(file);
  } catch (const FileError& error) {
    return error.what();
  }
  return "not refused";
}

constexpr const char* kWhole = R"(
title = "All keys"
goal = "Every key once."
task = "test"
car = "hatchback"
gate = "paper"
pass_grade = 7.5
time_limit_s = 45
shift_from_rpm = 1500
shift_to_rpm = 3000

[start]
gear = "2"
speed_km_per_h = 36
slope_percent = 10
hand_brake = 0.5
brake = 0.25
running = true

[[step]]
prompt = "Do it."
hint = "Like this."
patience_s = 3
within_s = 2.5
fails_after_s = 4
call = true
may_be_skipped = true
guide_to = "4"
[step.until]
ignition = true
running = false
cranking = false
clutch_locked = true
shift_light = false
braked = true
clutch_torque_above_nm = 30
clutch_above = 0.1
clutch_below = 0.9
throttle_above = 0.2
throttle_below = 0.8
brake_above = 0.3
brake_below = 0.7
hand_brake_above = 0.4
hand_brake_below = 0.6
engine_above_rpm = 600
engine_below_rpm = 6000
speed_above_km_per_h = -3.6
speed_below_km_per_h = 72
distance_above_m = 12
rolled_back_above_m = 2
held_s = 1.5

[[step]]
prompt = "Reverse."
until = { gear = "R" }

[[abort]]
says = "Too far."
when = { distance_above_m = 100 }

[faults]
stall = "fails"
jerk = "counts"
slow_step = "fails"
)";

}  // namespace

TEST_CASE("every key is read and converted to SI units") {
  const double rpm = 6.283185307179586 / 60.0;
  const Lesson lesson = parse_lesson(kWhole, "folder/whole.toml");
  CHECK(lesson.key == "whole");
  CHECK(lesson.title == "All keys");
  CHECK(lesson.goal == "Every key once.");
  CHECK(lesson.task == "test");
  CHECK(lesson.car == "hatchback");
  CHECK(lesson.gate == "paper");
  CHECK(lesson.pass_grade == 7.5);
  CHECK(lesson.time_limit == 45.0);
  CHECK(lesson.shift_from == doctest::Approx(1500 * rpm));
  CHECK(lesson.shift_to == doctest::Approx(3000 * rpm));
  CHECK(lesson.start.gear == 2);
  CHECK(lesson.start.speed == doctest::Approx(10.0));
  CHECK(std::tan(lesson.start.slope) == doctest::Approx(0.1));
  CHECK(lesson.start.hand_brake == 0.5);
  CHECK(lesson.start.brake == 0.25);
  CHECK(lesson.fails_on == std::vector<ErrorKind>{ErrorKind::stall, ErrorKind::slow_step});
  CHECK(lesson.counted == std::vector<ErrorKind>{ErrorKind::jerk});
  CHECK(lesson.text == kWhole);
  REQUIRE(lesson.steps.size() == 2);
  CHECK(lesson.steps[0].prompt == "Do it.");
  CHECK(lesson.steps[0].hint == "Like this.");
  CHECK(lesson.steps[0].patience == 3.0);
  CHECK(lesson.steps[0].within == 2.5);
  CHECK_FALSE(lesson.steps[1].within.has_value());
  CHECK(lesson.steps[0].fails_after == 4.0);
  CHECK(lesson.steps[0].may_be_skipped);
  CHECK_FALSE(lesson.steps[1].may_be_skipped);
  CHECK(lesson.steps[0].call);
  CHECK_FALSE(lesson.steps[1].call);
  CHECK(lesson.steps[0].gear == 4);
  CHECK(lesson.steps[1].gear == kReverseGear);  // a step that waits for a gear also guides the lever to that gear
  CHECK(lesson.steps[1].patience == 8.0);
  REQUIRE(lesson.aborts.size() == 1);
  CHECK(lesson.aborts[0].message == "Too far.");
  CHECK(lesson.aborts[0].when.distance_above == 100.0);
  const DriveCondition& c = lesson.steps[0].until;
  CHECK(c.ignition == true);
  CHECK(c.running == false);
  CHECK(c.cranking == false);
  CHECK(c.clutch_locked == true);
  CHECK(c.shift_light == false);
  CHECK(c.braked == true);
  CHECK(c.clutch_torque_above == 30.0);
  CHECK(c.clutch_above == 0.1);
  CHECK(c.clutch_below == 0.9);
  CHECK(c.throttle_above == 0.2);
  CHECK(c.throttle_below == 0.8);
  CHECK(c.brake_above == 0.3);
  CHECK(c.brake_below == 0.7);
  CHECK(c.hand_brake_above == 0.4);
  CHECK(c.hand_brake_below == 0.6);
  CHECK(*c.engine_above == doctest::Approx(600 * rpm));
  CHECK(*c.engine_below == doctest::Approx(6000 * rpm));
  CHECK(*c.speed_above == doctest::Approx(-1.0));
  CHECK(*c.speed_below == doctest::Approx(20.0));
  CHECK(c.distance_above == 12.0);
  CHECK(c.rolled_back_above == 2.0);
  CHECK(c.held == 1.5);
  CHECK_FALSE(c.gear.has_value());
}

// 1 mph is 1.609344 km/h.
TEST_CASE("a text in miles has every speed converted and nothing else") {
  const auto miles = [](std::string_view text) { return text_in_unit(text, SpeedUnit::mph); };
  CHECK(miles("Slow down to 55 km/h in fifth.") == "Slow down to 34 mph in fifth.");
  CHECK(miles("creep at 3 to 6 km/h for two seconds") == "creep at 2 to 4 mph for two seconds");
  CHECK(miles("In 2, at 30, 50 and 70 km/h, then 8.5 km/h") == "In 2, at 19, 31 and 43 mph, then 5 mph");
  CHECK(miles("Accelerate to 2200 rpm in first.") == "Accelerate to 2200 rpm in first.");
  CHECK(miles("at walking pace, in km/h") == "at walking pace, in mph");
  CHECK(miles(" km/h") == " mph");
  CHECK(miles("1.2.3 km/h") == "1.2 mph");
  CHECK(text_in_unit("55 km/h", SpeedUnit::km_per_h) == "55 km/h");
}

TEST_CASE("shift_to makes three steps: clutch down, which may be skipped, the gear, and clutch up") {
  const std::string head = "title = 'T'\ngoal = 'G'\ntask = 't'\n";
  const Lesson lesson =
      parse_lesson(head + "[[step]]\nshift_to = '3'\nhint = 'Up.'\n[faults]\nstall = 'fails'\n", "l.toml");
  REQUIRE(lesson.steps.size() == 3);
  CHECK(lesson.steps[0].may_be_skipped);
  CHECK(lesson.steps[0].until.clutch_above.has_value());
  CHECK_FALSE(lesson.steps[0].until.gear.has_value());
  CHECK(lesson.steps[1].hint == "Up.");
  for (const std::size_t i : {1u, 2u}) {
    CHECK_FALSE(lesson.steps[i].may_be_skipped);
    CHECK(lesson.steps[i].gear == 3);
    CHECK(lesson.steps[i].until.gear == 3);
  }
  CHECK(lesson.steps[2].until.clutch_locked == true);
  CHECK(lesson.steps[2].until.clutch_below.has_value());
}

TEST_CASE(
    "a band taken from the car begins a tenth below the car's band, and ends above it to allow for the reaction time") {
  CarSpec car;
  car.engine.shift_low = 200.0;
  car.engine.shift_high = 250.0;
  Lesson lesson;
  lesson.shift_from = 150.0;
  lesson.shift_to = 400.0;
  CHECK(lesson_in_car(lesson, car).shift_to == 400.0);
  lesson.band_of_car = true;
  CHECK(lesson_in_car(lesson, car).shift_from == doctest::Approx(180.0));
  CHECK(lesson_in_car(lesson, car).shift_to == doctest::Approx(325.0));
}

TEST_CASE("a step may state the speed for its gear, so early and late shifts can be judged without a band") {
  const std::string head = "title = 'T'\ngoal = 'G'\ntask = 't'\n", tail = "[faults]\nearly_shift = 'fails'\n";
  const Lesson lesson = parse_lesson(head + "[[step]]\nshift_to = '3'\nat_km_per_h = 36\n" + tail, "l.toml");
  CHECK_FALSE(lesson.steps[0].at.has_value());
  CHECK(*lesson.steps[1].at == doctest::Approx(10.0));
  CHECK_FALSE(lesson.steps[2].at.has_value());
  const std::string step = "[[step]]\nprompt = 'P'\nat_km_per_h = 36\nuntil = { gear = ";
  CHECK(*parse_lesson(head + step + "'2' }\n" + tail, "l.toml").steps[0].at == doctest::Approx(10.0));
  CHECK_THROWS_AS(parse_lesson(head + step + "'R' }\n" + tail, "l.toml"), FileError);
}

TEST_CASE("the errors that fail a lesson are described in one sentence, which is empty if nothing fails it") {
  Lesson lesson;
  CHECK(failing_errors_sentence(lesson).empty());
  lesson.fails_on = {ErrorKind::stall, ErrorKind::clutch_dump};
  lesson.counted = {ErrorKind::jerk};
  CHECK(failing_errors_sentence(lesson) == "You fail if you stall or dump the clutch.");
}

TEST_CASE("every hostile lesson is rejected in one sentence with file, line and reason") {
  for (const Hostile& hostile : kHostile) {
    const std::filesystem::path file = std::filesystem::path(kFolder) / (std::string(hostile.file) + ".toml");
    const std::string sentence = refusal(file);
    CAPTURE(sentence);
    CHECK(sentence.find(file.string() + hostile.sentence) == 0);
    CHECK(is_printable(sentence));
  }
}

TEST_CASE("no hostile lesson is left untested") {
  std::set<std::string> expected, found;
  for (const Hostile& hostile : kHostile) expected.insert(hostile.file);
  for (const auto& entry : std::filesystem::directory_iterator(kFolder)) found.insert(entry.path().stem().string());
  CHECK(found == expected);
}
