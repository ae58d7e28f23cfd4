#include "app/lessons/assessment/lesson.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include <fmt/core.h>

#include "app/lessons/assessment/clutch_release.h"
#include "app/lessons/assessment/drive_condition.h"
#include "app/lessons/assessment/gate_path.h"
#include "app/lessons/assessment/lever_path_text.h"
#include "haptics/files/parameter_file.h"
#include "haptics/files/text_file.h"
#include "haptics/files/toml_reader.h"

namespace gearshift::lessons {
namespace {

constexpr double kRadPerSecond = 6.283185307179586 / 60.0;  // per rpm

// Allowed ranges of the values in a lesson file, in the file's units.
constexpr haptics::Range kEngineRpm{0.0, 10000.0};
constexpr haptics::Range kSlopePercent{-30.0, 30.0};
constexpr std::size_t kMaxSteps = 64;

// Conditions of the steps that the key `shift_to` in a lesson file creates. Engineering values.
constexpr double kClutchDown = 0.8;        // [1] pedal position beyond every car's bite point
constexpr double kClutchUp = 0.2;          // [1]
constexpr double kFootOffThrottle = 0.05;  // [1]
constexpr double kPedalPatience = 6.0;     // [s]

// Tolerance around the car's upshift band. The shift light comes on at the band's upper end, and the driver needs 1.05
// s to see the light and lift the foot (Green 2000). In this time, in first gear at a third of the throttle, the engine
// gains up to 580 rpm. The factor 1.3 allows 750 rpm in the hatchback (band up to 2500 rpm) and 660 rpm in the diesel
// (up to 2200 rpm). Engineering values.
constexpr double kBandFrom = 0.9, kBandTo = 1.3;  // [1] factors for the lower and upper end of the band

constexpr double kSamePath = 0.01;  // [1] paths of the lever in one gate differ by less; in two gates by more

// Labels from reverse to the highest gear: "R", "N", "1", "2", ...
const std::vector<std::string>& gear_labels() {
  static const std::vector<std::string> words = [] {
    std::vector<std::string> list;
    for (int gear = haptics::kReverseGear; gear <= haptics::kMaxGear; ++gear)
      list.emplace_back(haptics::gear_name(gear));
    return list;
  }();
  return words;
}

int read_gear(const haptics::TomlTable& table, std::string_view key) {
  const std::string word = table.choice(key, gear_labels());
  return haptics::kReverseGear +
         static_cast<int>(std::find(gear_labels().begin(), gear_labels().end(), word) - gear_labels().begin());
}

std::string text_or_none(const haptics::TomlTable& table, std::string_view key) {
  return table.has(key) ? table.text(key) : std::string();
}

// Rejects a pair of limits that leaves no value between them. name: "clutch"; unit: "", "_rpm", ...
void check_between(const haptics::TomlTable& table, const std::string& name, const std::string& unit) {
  const std::string above = name + "_above" + unit, below = name + "_below" + unit;
  constexpr haptics::Range kAny{-1e9, 1e9};
  if (table.has(above) && table.has(below) && table.number(above, kAny) >= table.number(below, kAny))
    table.fail(above, "could never be met; the value must be smaller than " + below);
}

DriveCondition read_condition(const haptics::TomlTable& table) {
  DriveCondition c;
  if (table.has("gear")) c.gear = read_gear(table, "gear");
  haptics::read_parameters(table, c);
  for (const char* pedal : {"clutch", "throttle", "brake", "hand_brake"}) check_between(table, pedal, "");
  check_between(table, "engine", "_rpm");
  check_between(table, "speed", "_km_per_h");
  table.reject_unknown_keys();
  if (is_empty(c)) table.fail({}, "the condition is empty and would be met at once");
  if (c.clutch_holds_car == false) table.fail("clutch_holds_car", "must be true; without it, leave it out");
  if (c.clutch_holds_car && (c.clutch_torque_above || !c.gear || *c.gear == haptics::kNeutralGear))
    table.fail("clutch_holds_car", "needs a gear, and excludes clutch_torque_above_nm");
  return c;
}

LessonStart read_start(const haptics::TomlTable& table) {
  LessonStart start;
  if (table.has("gear")) start.gear = read_gear(table, "gear");
  haptics::read_parameters(table, start);
  start.slope = std::atan(table.number_or("slope_percent", 0.0, kSlopePercent) / 100.0);
  table.reject_unknown_keys();
  if (start.gear == haptics::kReverseGear && start.speed > 0.0) table.fail("speed_km_per_h", "must be 0 in gear R");
  if (start.running && start.speed == 0.0 && start.gear != haptics::kNeutralGear)
    table.fail("gear", "must be \"N\" if the car stands and the engine runs, or it would stall at once");
  if (!start.running && start.speed > 0.0) table.fail("speed_km_per_h", "must be 0 if the engine is not running");
  return start;
}

void check_at(const haptics::TomlTable& table, const LessonStep& step) {
  if (step.at && step.until.gear.value_or(haptics::kNeutralGear) < 1)
    table.fail("at_km_per_h", "is allowed only in a step that waits for a forward gear");
}

// Reads one step. A step that waits for a gear guides the lever to that gear, so its `guide_to` must not name a
// different one. Any other step guides the lever to the gear that its `guide_to` names, if any.
LessonStep read_step(const haptics::TomlTable& table) {
  LessonStep step;
  step.prompt = table.text("prompt");
  step.hint = text_or_none(table, "hint");
  haptics::read_parameters(table, step);
  step.until = read_condition(table.table("until"));
  if (step.within && *step.within <= step.until.held) {
    table.fail("within_s", "must be longer than held_s of the same step, or no attempt could be in time");
  }
  if (step.fails_after && (!step.within || *step.fails_after < *step.within)) {
    table.fail("fails_after_s", "must be at least within_s, which this step must also set");
  }
  step.gear = step.until.gear.value_or(haptics::kNeutralGear);
  if (table.has("guide_to")) step.gear = read_gear(table, "guide_to");
  if (step.until.gear && *step.until.gear != haptics::kNeutralGear && step.gear != *step.until.gear) {
    table.fail("guide_to", std::string("leads away from gear ") + haptics::gear_name(*step.until.gear) +
                               ", which this step waits for");
  }
  check_at(table, step);
  table.reject_unknown_keys();
  return step;
}

// Adds three steps for a line such as `shift_to = "3"`: clutch down, shift into the gear, clutch up. Only the first
// step may be skipped.
void add_shift(const haptics::TomlTable& table, std::vector<LessonStep>& steps) {
  const int gear = read_gear(table, "shift_to");
  if (gear == haptics::kNeutralGear)
    table.fail("shift_to", "must be a gear; to shift into N, write a step that waits for N");
  LessonStep down, lever, up;
  down.prompt = "Off the throttle, clutch down.";
  down.hint = "Press the clutch pedal all the way down, past the bite point.";
  down.patience = kPedalPatience;
  down.until.throttle_below = kFootOffThrottle;
  down.until.clutch_above = kClutchDown;
  down.may_be_skipped = true;
  lever.prompt = "Shift into " + gear_word(gear) + ".";
  lever.hint = text_or_none(table, "hint");
  lever.until.gear = gear;
  up.prompt = "Clutch up, then throttle.";
  up.hint = "Let the clutch up smoothly through the bite point, then press the throttle.";
  up.until.gear = gear;
  up.until.clutch_below = kClutchUp;
  up.until.clutch_locked = true;
  lever.gear = up.gear = gear;
  constexpr auto& kAt = haptics::parameter_of(&LessonStep::at);
  if (table.has(kAt.key)) lever.at = haptics::read_number(table, kAt, {kAt.range.min, kAt.range.max});
  check_at(table, lever);
  table.reject_unknown_keys();
  steps.insert(steps.end(), {down, lever, up});
}

LessonAbort read_abort(const haptics::TomlTable& table) {
  LessonAbort abort;
  abort.message = table.text("says");
  abort.when = read_condition(table.table("when"));
  table.reject_unknown_keys();
  return abort;
}

bool has(const std::vector<ErrorKind>& kinds, ErrorKind kind) noexcept {
  return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

// Reads the table [faults], which contains "counts" or "fails" for each kind of error that this lesson assesses.
void read_error_rules(const haptics::TomlTable& table, Lesson& lesson) {
  for (int i = 0; i < kErrorKindCount; ++i) {
    const auto kind = static_cast<ErrorKind>(i);
    if (!table.has(to_string(kind))) continue;
    const bool fails = table.choice(to_string(kind), {"counts", "fails"}) == "fails";
    (fails ? lesson.fails_on : lesson.counted).push_back(kind);
  }
  table.reject_unknown_keys();
  if (lesson.fails_on.empty() && lesson.counted.empty())
    table.fail({}, "[faults] must name at least one error, or the lesson's grade would mean nothing");
}

// True if a step has a target speed. Without target speeds, a shift can be too early or too late only if the lesson has
// an upshift band.
bool has_speeds(const Lesson& lesson) {
  return std::any_of(lesson.steps.begin(), lesson.steps.end(),
                     [](const LessonStep& step) { return step.at.has_value(); });
}

void read_shift_band(const haptics::TomlTable& root, Lesson& lesson) {
  if (root.has("shift_band")) {
    lesson.band_of_car = root.choice("shift_band", {"car"}) == "car";
    for (const std::string_view key : {"shift_from_rpm", "shift_to_rpm"}) {
      if (root.has(key)) root.fail(key, "cannot be combined with shift_band, which uses the car's own limits");
    }
    return;
  }
  lesson.shift_from = root.number_or("shift_from_rpm", 0.0, kEngineRpm) * kRadPerSecond;
  if (root.has("shift_to_rpm")) lesson.shift_to = root.number("shift_to_rpm", kEngineRpm) * kRadPerSecond;
  if (lesson.shift_from >= lesson.shift_to) root.fail("shift_from_rpm", "must be smaller than shift_to_rpm");
  if (has_speeds(lesson)) return;
  if (assesses(lesson, ErrorKind::early_shift) && !root.has("shift_from_rpm")) {
    root.fail("shift_from_rpm", "is missing, but this lesson checks early_shift");
  }
  if (assesses(lesson, ErrorKind::late_shift) && !root.has("shift_to_rpm")) {
    root.fail("shift_to_rpm", "is missing, but this lesson checks late_shift");
  }
}

void read_steps(const haptics::TomlTable& root, Lesson& lesson) {
  for (const haptics::TomlTable& table : root.tables("step")) {
    if (table.has("shift_to")) {
      add_shift(table, lesson.steps);
    } else {
      lesson.steps.push_back(read_step(table));
    }
  }
  if (lesson.steps.empty()) root.fail("step", "is missing: write one [[step]] for each action");
  if (lesson.steps.size() > kMaxSteps)
    root.fail("step", "has more than 64 steps (each shift_to counts as three); split the lesson in two");
  for (const haptics::TomlTable& table : root.tables("abort")) lesson.aborts.push_back(read_abort(table));
}

// Rejects the rule `wrong_gear` in a lesson that never asks for a gear.
void check_wrong_gear(const haptics::TomlTable& errors, const Lesson& lesson) {
  const auto asks = [](const LessonStep& step) { return step.gear != haptics::kNeutralGear; };
  const std::string_view key = to_string(ErrorKind::wrong_gear);
  if (!errors.has(key) || std::any_of(lesson.steps.begin(), lesson.steps.end(), asks)) return;
  errors.fail(key, "no step asks for a gear, so no gear could be wrong");
}

// Rejects the rule `slow_step` in a lesson without time limits for steps, and time limits for steps without this rule.
void check_slow_step(const haptics::TomlTable& root, const Lesson& lesson) {
  const auto timed = [](const LessonStep& step) { return step.within.has_value(); };
  const bool has = std::any_of(lesson.steps.begin(), lesson.steps.end(), timed);
  const std::string_view key = to_string(ErrorKind::slow_step);
  const haptics::TomlTable errors = root.table("faults");
  if (errors.has(key) && !has) errors.fail(key, "no step sets within_s, so no step could be slow");
  if (has && !errors.has(key)) errors.fail(key, "is missing, but a step sets within_s");
  const auto fails = [](const LessonStep& step) { return step.fails_after.has_value(); };
  const bool may_fail = std::any_of(lesson.steps.begin(), lesson.steps.end(), fails);
  if (may_fail && !fails_on(lesson, ErrorKind::slow_step))
    errors.fail(key, "must be \"fails\", because a step sets fails_after_s");
}

// Rejects a lesson whose steps must be held, in total, for at least the lesson's time limit.
void check_times(const haptics::TomlTable& root, const Lesson& lesson) {
  double held = 0.0;
  for (const LessonStep& step : lesson.steps) held += step.until.held;
  if (held >= lesson.time_limit) root.fail("time_limit_s", "must be longer than the sum of held_s over all steps");
}

bool is_digit(char c) noexcept {
  return c >= '0' && c <= '9';
}

// Where the speeds at the end of `text` begin, at `from` or later; they may be a list such as "30, 50 and 70".
std::size_t speeds_begin(std::string_view text, std::size_t from) {
  std::size_t begin = text.size();
  for (bool more = true; more;) {
    while (begin > from && (is_digit(text[begin - 1]) || text[begin - 1] == '.')) --begin;
    more = false;
    for (const std::string_view joint : {", ", " to ", " and ", " or "}) {
      const bool joins = begin > from + joint.size() && text.substr(0, begin).ends_with(joint) &&
                         is_digit(text[begin - joint.size() - 1]);
      if (joins) begin -= joint.size(), more = true;
    }
  }
  return begin;
}

// Numbers are in km/h, all other characters stay.
std::string converted_speeds(std::string_view list, vehicle::SpeedUnit unit) {
  std::string out;
  while (!list.empty()) {
    double speed = 0.0;
    const auto [end, error] = std::from_chars(list.data(), list.data() + list.size(), speed, std::chars_format::fixed);
    const bool is_number = error == std::errc() && is_digit(list.front());
    out += is_number ? fmt::format("{:.0f}", vehicle::in_unit(unit, speed / haptics::kKmhPerMps))
                     : std::string(list.substr(0, 1));
    list.remove_prefix(is_number ? static_cast<std::size_t>(end - list.data()) : 1);
  }
  return out;
}

}  // namespace

bool fails_on(const Lesson& lesson, ErrorKind kind) noexcept {
  return has(lesson.fails_on, kind);
}

bool assesses(const Lesson& lesson, ErrorKind kind) noexcept {
  return has(lesson.fails_on, kind) || has(lesson.counted, kind);
}

std::string failing_errors_sentence(const Lesson& lesson) {
  std::string names;
  for (const ErrorKind kind : lesson.fails_on) {
    if (!names.empty()) names += kind == lesson.fails_on.back() ? " or " : ", ";
    names += error_action(kind);
  }
  return names.empty() ? names : "You fail if you " + names + ".";
}

std::string text_in_unit(std::string_view text, vehicle::SpeedUnit unit) {
  if (unit == vehicle::SpeedUnit::km_per_h) return std::string(text);
  constexpr std::string_view kUnit = " km/h";
  std::string out;
  std::size_t done = 0;
  for (std::size_t at; (at = text.find(kUnit, done)) != text.npos; done = at + kUnit.size()) {
    const std::size_t begin = speeds_begin(text.substr(0, at), done);
    out += text.substr(done, begin - done);
    out += converted_speeds(text.substr(begin, at - begin), unit) + ' ' + to_string(unit);
  }
  return out.append(text.substr(done));
}

Lesson lesson_in_car(const Lesson& lesson, const vehicle::CarSpec& car) {
  Lesson driven = lesson;
  driven.goal = text_in_unit(lesson.goal, car.speed_unit);
  for (LessonStep& step : driven.steps) {
    step.prompt = text_in_unit(step.prompt, car.speed_unit);
    step.hint = text_in_unit(step.hint, car.speed_unit);
  }
  for (LessonAbort& abort : driven.aborts) abort.message = text_in_unit(abort.message, car.speed_unit);
  for (LessonStep& step : driven.steps) {
    DriveCondition& until = step.until;
    if (until.clutch_holds_car) until.clutch_torque_above = std::abs(hill_torque(car, *until.gear, lesson.start.slope));
    until.clutch_holds_car.reset();
  }
  if (!lesson.band_of_car) return driven;
  driven.shift_from = kBandFrom * car.engine.shift_low;
  driven.shift_to = kBandTo * car.engine.shift_high;
  return driven;
}

std::vector<Norm> norms_beside(const std::filesystem::path& lesson) {
  const std::filesystem::path file = lesson.parent_path() / "norms" / "simulated.toml";
  std::error_code ignored;
  return std::filesystem::exists(file, ignored) ? read_norms(file) : std::vector<Norm>{};
}

Lesson read_lesson(const std::filesystem::path& file) {
  return read_lesson(file, norms_beside(file));
}

Lesson read_lesson(const std::filesystem::path& file, std::span<const Norm> norms) {
  Lesson lesson = parse_lesson(haptics::read_text_file(file), file.string());
  for (const Norm& norm : norms)
    if (norm.lesson == lesson.key) lesson.norms.push_back(norm);
  return lesson;
}

const Norm* norm_of(const Lesson& lesson, LessonMode mode) noexcept {
  const auto found =
      std::find_if(lesson.norms.begin(), lesson.norms.end(), [&](const Norm& norm) { return norm.mode == mode; });
  return found == lesson.norms.end() ? nullptr : &*found;
}

const Norm* norm_of(const Lesson& lesson, LessonMode mode, const vehicle::CarSpec& car, const haptics::Gate& gate) {
  const Norm* norm = norm_of(lesson, mode);
  const bool fits = norm != nullptr && norm->car == car.name &&
                    std::abs(lesson_path_length(lesson, gate) - norm->path_length) <= kSamePath * norm->path_length;
  return fits ? norm : nullptr;
}

double lesson_path_length(const Lesson& lesson, const haptics::Gate& gate) {
  double length = 0.0;
  glm::dvec2 at = haptics::rest_position(gate, lesson.start.gear);
  for (const LessonStep& step : lesson.steps) {
    if (!step.until.gear) continue;
    const glm::dvec2 next = haptics::rest_position(gate, *step.until.gear);
    length += shortest_path_length(gate, at, next);
    at = next;
  }
  return length;
}

Lesson parse_lesson(std::string_view text, const std::string& file_name) {
  Lesson lesson;
  lesson.file = file_name;
  lesson.text = text;
  lesson.key = std::filesystem::path(file_name).stem().string();
  const haptics::TomlTable root = haptics::TomlTable::parse(text, file_name);
  lesson.title = root.text("title");
  lesson.goal = root.text("goal");
  lesson.task = root.text("task");
  lesson.car = text_or_none(root, "car");
  lesson.gate = text_or_none(root, "gate");
  haptics::read_parameters(root, lesson);
  if (root.has("start")) lesson.start = read_start(root.table("start"));
  read_steps(root, lesson);
  read_error_rules(root.table("faults"), lesson);
  check_wrong_gear(root.table("faults"), lesson);
  check_slow_step(root, lesson);
  read_shift_band(root, lesson);
  root.reject_unknown_keys();
  check_times(root, lesson);
  return lesson;
}

vehicle::CarStart car_start(const LessonStart& start) noexcept {
  vehicle::CarStart from;
  from.road_speed = start.speed;
  from.gear = start.gear;
  from.running = start.running;
  return from;
}

}  // namespace gearshift::lessons
