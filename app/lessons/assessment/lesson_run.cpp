#include "app/lessons/assessment/lesson_run.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/core.h>

#include "app/lessons/assessment/drive_condition.h"
#include "app/lessons/assessment/error_detector.h"
#include "app/lessons/assessment/grade.h"
#include "app/lessons/assessment/lever_path_text.h"
#include "app/lessons/assessment/pedal_corrections.h"
#include "app/lessons/assessment/shift_meter.h"

namespace gearshift::lessons {
namespace {

// [s] A guided run has no clock, but ends some time, also with a simulated driver that never does the next step.
constexpr double kMaxGuided = 600.0;

// [s] Longest wait after the last step for a shift in progress to end. Engineering value.
constexpr double kMaxShiftOverrun = 3.0;
// [s] Time to read the two prompts that appear while the clutch is down. Each takes 0.75 s to react to an expected
// signal and 0.3 s to read (Green. How long does it take to stop? 2000).
constexpr double kReading = 2.0 * 1.05;
constexpr double kMaxOffCourseTime = 3.0;  // [s] time in a wrong gear after which a hint is shown (engineering value)

void check_gear(const Lesson& lesson, const haptics::Gate& gate, int gear) {
  if (gear == haptics::kNeutralGear || haptics::slot_of_gear(gate, gear) != haptics::kNoSlot) return;
  throw std::invalid_argument("lesson " + lesson.key + " needs gear " + haptics::gear_name(gear) +
                              ", which this gate does not have; choose another gate");
}

void check_gears(const Lesson& lesson, const haptics::Gate& gate) {
  if (haptics::is_sequential(gate))
    throw std::invalid_argument("lesson " + lesson.key +
                                " needs a gate with a slot for each gear, and this one is sequential; choose another "
                                "gate");
  check_gear(lesson, gate, lesson.start.gear);
  for (const LessonStep& step : lesson.steps) {
    check_gear(lesson, gate, step.gear);
    check_gear(lesson, gate, step.until.gear.value_or(haptics::kNeutralGear));
  }
  for (const LessonAbort& abort : lesson.aborts)
    check_gear(lesson, gate, abort.when.gear.value_or(haptics::kNeutralGear));
}

// Throws if the lesson can be passed in this car only with an engine beyond its red line.
void check_revs(const Lesson& lesson, const vehicle::CarSpec& car) {
  const auto refuse = [&](const std::string& what, double speed) {
    throw std::invalid_argument(fmt::format(
        "lesson {} {} {:.0f} rpm, but the red line of the car \"{}\" is at {:.0f}; "
        "choose another car",
        lesson.key, what, speed / haptics::kTurnPerMinute, car.name, car.engine.red_line / haptics::kTurnPerMinute));
  };
  const double start = std::abs(vehicle::shaft_per_road(car, lesson.start.gear)) * lesson.start.speed;
  if (start > car.engine.red_line) refuse("starts at", start);
  for (std::size_t i = 0; i < lesson.steps.size(); ++i) {
    const DriveCondition& until = lesson.steps[i].until;
    const double turns = vehicle::shaft_per_road(car, until.gear.value_or(haptics::kNeutralGear));
    const double above = std::max(until.engine_above.value_or(0.0), turns * until.speed_above.value_or(0.0));
    if (above >= car.engine.red_line) refuse(fmt::format("asks in step {} for", i + 1), above);
  }
  if (lesson.shift_from >= car.engine.red_line) refuse("asks to shift up from", lesson.shift_from);
}

// Throws if the lesson asks for more speed than this car reaches.
void check_speeds(const Lesson& lesson, const vehicle::CarSpec& car) {
  const double top = vehicle::top_speed(car);
  for (std::size_t i = 0; i < lesson.steps.size(); ++i) {
    const double above = lesson.steps[i].until.speed_above.value_or(0.0);
    if (above <= 0.0 || top <= 0.0 || above < top) continue;
    throw std::invalid_argument(
        fmt::format("lesson {} asks in step {} for {:.0f} {unit}, but the car \"{}\" reaches {:.0f} {unit}; choose "
                    "another car",
                    lesson.key, i + 1, vehicle::in_unit(car.speed_unit, above), car.name,
                    vehicle::in_unit(car.speed_unit, top), fmt::arg("unit", to_string(car.speed_unit))));
  }
}

}  // namespace

struct LessonRun::State {
  State(const Lesson& a_lesson, const vehicle::CarSpec& car, const haptics::Gate& a_gate,
        const LessonRunConfig& a_config)
      : lesson(lesson_in_car(a_lesson, car)),
        gate(a_gate),
        config(a_config),
        meter(car, gate),
        detector(car, gate, {lesson.shift_from, lesson.shift_to}, shows_prompts(a_config) ? kReading : 0.0),
        abort_held(a_lesson.aborts.size()),
        norm(norm_of(lesson, a_config.mode, car, gate)) {}

  static bool shows_prompts(const LessonRunConfig& config) { return config.mode == LessonMode::follow_me; }
  void begin(const vehicle::DriveSample& sample);
  void measure(const vehicle::DriveSample& sample);
  void measure_jerk(const vehicle::DriveSample& sample);
  void measure_feet(const vehicle::DriveSample& sample);
  void add_shift(const std::optional<ShiftRecord>& ended);
  void apply_errors(std::vector<DrivingError> errors);
  void attribute(DrivingError& error) const;
  int gear_wanted(int gear) const noexcept;
  double speed_wanted(int gear) const noexcept;
  bool aborts(const vehicle::DriveSample& sample);
  void follow_steps(const vehicle::DriveSample& sample);
  std::size_t steps_ahead(const vehicle::DriveSample& sample);
  void judge_time(double time);
  void go_to(std::size_t step);
  void update_hint(const vehicle::DriveSample& sample);
  bool is_off_course(const vehicle::DriveSample& sample);
  int gear_before(std::size_t step) const noexcept;
  std::string hint_of(std::size_t step) const;
  void end(LessonEnd how);
  DriveProgress progress() const { return {last.car.distance - start_distance, highest - last.car.distance}; }
  bool all_done() const { return view.step >= lesson.steps.size(); }

  Lesson lesson;
  haptics::Gate gate;
  LessonRunConfig config;
  PedalCorrections corrections;
  ShiftMeter meter;
  ErrorDetector detector;
  HeldCondition held;
  std::vector<HeldCondition> ahead;  // conditions of the steps that can be reached by skipping
  std::vector<HeldCondition> abort_held;
  const Norm* norm;  // of `lesson`; may be null
  LessonView view;
  LessonResult result;
  std::vector<ShiftRecord> new_shifts;
  vehicle::DriveSample last;
  bool began = false;
  double start_distance = 0.0;  // [m]
  double start_slip = 0.0;      // [J]
  double highest = 0.0;         // [m] largest distance reached in the current step
  double step_began = 0.0;      // [s]
  double steps_done = 0.0;      // [s] time when the last step was completed
  double on_course = 0.0;       // [s] time when the car was last in a gear that the step allows
};

LessonRun::LessonRun(const Lesson& lesson, const vehicle::CarSpec& car, const haptics::Gate& gate,
                     const LessonRunConfig& config) {
  check_gears(lesson, gate);
  check_revs(lesson_in_car(lesson, car), car);
  check_speeds(lesson, car);
  state_ = std::make_unique<State>(lesson, car, gate, config);
  LessonResult& result = state_->result;
  result.lesson = lesson.key;
  result.task = lesson.task;
  result.mode = config.mode;
  result.car = car.name;
  result.path_length = lesson_path_length(lesson, gate);
  result.lever_help = config.guidance;
  result.pedal_help = config.pedal_help;
  result.guided = config.guidance > 0.0 || config.pedal_help > 0.0;
  state_->view.steps = lesson.steps.size();
  state_->go_to(0);
  grade_result(lesson, result);
}

LessonRun::~LessonRun() = default;

void LessonRun::add(const vehicle::DriveSample& sample) {
  if (is_over()) return;
  State& state = *state_;
  if (!state.began) state.begin(sample);
  state.measure(sample);
  state.last = sample;
  if (state.aborts(sample)) return;
  state.follow_steps(sample);
  const double time = sample.time();
  const bool shift_ends = !state.meter.is_open() && !state.meter.is_pending();
  if (state.all_done() && (shift_ends || time - state.steps_done > kMaxShiftOverrun)) {
    state.end(LessonEnd::done);
  } else if (state.result.duration >= (state.result.guided ? kMaxGuided : state.lesson.time_limit)) {
    state.end(LessonEnd::out_of_time);
  } else {
    state.update_hint(sample);
  }
}

void LessonRun::State::begin(const vehicle::DriveSample& sample) {
  began = true;
  last = sample;
  result.begin = step_began = on_course = sample.time();
  start_distance = highest = sample.car.distance;
  start_slip = sample.car.slip_energy;
}

void LessonRun::State::measure_feet(const vehicle::DriveSample& sample) {
  corrections.add(sample.car.pedals, sample.time() - (result.begin + result.duration));
  result.figures.pedal_corrections = corrections.rate();
}

void LessonRun::State::measure(const vehicle::DriveSample& sample) {
  measure_feet(sample);
  result.duration = sample.time() - result.begin;
  result.slip_energy = sample.car.slip_energy - start_slip;
  result.lever_help = std::max(result.lever_help, sample.controls.guidance);
  result.guided = result.guided || result.lever_help > 0.0;
  highest = std::max(highest, sample.car.distance);

  const std::optional<ShiftRecord> ended = meter.add(sample);
  measure_jerk(sample);
  detector.add(sample, gear_wanted(sample.car.gear), meter.is_open(), speed_wanted(sample.car.gear));
  add_shift(ended);
  apply_errors(detector.drain_errors());
}

void LessonRun::State::measure_jerk(const vehicle::DriveSample& sample) {
  double& peak = result.figures.jerk_peak ? *result.figures.jerk_peak : result.figures.jerk_peak.emplace(0.0);
  if (sample.car.pedals.brake < kMaxBrakeForJerk) peak = std::max(peak, std::abs(meter.jerk()));
}

void LessonRun::State::add_shift(const std::optional<ShiftRecord>& ended) {
  if (!ended) return;
  detector.check_shift(*ended);
  result.shifts.push_back(*ended);
  new_shifts.push_back(*ended);
  for (DrivingError& error : result.errors) attribute(error);
}

// An error of a kind that this lesson does not assess becomes a note.
void LessonRun::State::apply_errors(std::vector<DrivingError> errors) {
  for (DrivingError& error : errors) {
    const bool counts = assesses(lesson, error.kind);
    if (!counts) error.severity = Severity::note;
    attribute(error);
    result.errors.push_back(error);
    if (counts && config.hints != HintStyle::summary) view.feedback.push_back(error_sentence(error));
  }
  if (!errors.empty()) grade_result(lesson, result);
}

// Assigns an error to the shift in which the error was made. Error and shift may be reported in any order.
void LessonRun::State::attribute(DrivingError& error) const {
  for (const ShiftRecord& record : result.shifts) {
    if (error.shift < 0 && error.time >= record.begin && error.time <= record.end) error.shift = record.number;
  }
}

// Considers the current step and the steps that can be reached by skipping. Returns `gear` if one of them asks for it,
// otherwise the gear of the last step among them that asks for a gear.
int LessonRun::State::gear_wanted(int gear) const noexcept {
  int wanted = haptics::kNeutralGear;
  for (std::size_t i = view.step; !all_done() && i <= view.step + ahead.size(); ++i) {
    const int meant = lesson.steps[i].gear;
    if (meant != haptics::kNeutralGear && wanted != gear) wanted = meant;
  }
  return wanted;
}

// Road speed at which the current step, or a step that can be reached by skipping, asks for `gear` [m/s]; 0: any speed.
double LessonRun::State::speed_wanted(int gear) const noexcept {
  for (std::size_t i = view.step; !all_done() && i <= view.step + ahead.size(); ++i) {
    if (lesson.steps[i].at && lesson.steps[i].until.gear == gear) return *lesson.steps[i].at;
  }
  return 0.0;
}

bool LessonRun::State::aborts(const vehicle::DriveSample& sample) {
  for (std::size_t i = 0; i < lesson.aborts.size(); ++i) {
    if (!abort_held[i].update(lesson.aborts[i].when, sample, progress())) continue;
    result.why = lesson.aborts[i].message;
    end(LessonEnd::aborted);
    return true;
  }
  return false;
}

// A step that may be skipped also ends when a later step is done, so that it does not block the learner. The later step
// counts as done only if its condition was false when the current step began.
void LessonRun::State::follow_steps(const vehicle::DriveSample& sample) {
  while (!all_done()) {
    const bool done = held.update(lesson.steps[view.step].until, sample, progress());
    const std::size_t skipped = steps_ahead(sample);
    if (!done && skipped == 0) return;
    judge_time(sample.time());
    step_began = steps_done = on_course = sample.time();
    highest = sample.car.distance;
    go_to(view.step + (done ? 1 : skipped + 1));
  }
}

// Number of steps that the learner has just skipped, including the current step; 0: none.
std::size_t LessonRun::State::steps_ahead(const vehicle::DriveSample& sample) {
  std::size_t skipped = 0;
  for (std::size_t i = 0; i < ahead.size(); ++i) {
    const DriveCondition& until = lesson.steps[view.step + 1 + i].until;
    if (ahead[i].update(until, sample, progress()) && ahead[i].began_false()) skipped = i + 1;
  }
  return skipped;
}

// Judges how long the current step took until `time` [s], when the step was completed or skipped, or the lesson ended.
void LessonRun::State::judge_time(double time) {
  const LessonStep& step = lesson.steps[view.step];
  const double took = time - step_began;
  if (!step.within || took < error_rule(ErrorKind::slow_step).raise * *step.within) return;
  DrivingError error =
      make_driving_error(ErrorKind::slow_step, error_severity(ErrorKind::slow_step, took / *step.within), time, took);
  error.step = step.prompt;
  error.time_limit = *step.within;
  apply_errors({error});
}

void LessonRun::State::go_to(std::size_t step) {
  view.step = step;
  view.hint.clear();
  held.reset();
  ahead.clear();
  for (std::size_t i = step; i + 1 < lesson.steps.size() && lesson.steps[i].may_be_skipped; ++i) ahead.emplace_back();
  view.guided_gear = all_done() ? haptics::kNeutralGear : lesson.steps[step].gear;
  const bool prompted = !all_done() && (config.mode == LessonMode::follow_me || lesson.steps[step].call);
  view.prompt = prompted ? lesson.steps[step].prompt : lesson.goal;
}

// In a wrong gear the step can never be completed, so the hint to change gear is shown in every hint style.
void LessonRun::State::update_hint(const vehicle::DriveSample& sample) {
  if (all_done()) return;
  const LessonStep& step = lesson.steps[view.step];
  if (is_off_course(sample)) {
    view.hint = fmt::format("Shift into {} to continue.", gear_word(*step.until.gear));
  } else if (config.hints == HintStyle::prescriptive && sample.time() - step_began >= step.patience) {
    view.hint = hint_of(view.step);
  } else {
    view.hint.clear();
  }
}

// Returns the gear in which the steps before `index` leave the car.
int LessonRun::State::gear_before(std::size_t index) const noexcept {
  int gear = lesson.start.gear;
  for (std::size_t i = 0; i < index; ++i) gear = lesson.steps[i].until.gear.value_or(gear);
  return gear;
}

// Returns the hint from the lesson file. If there is none and the step waits for a gear, returns a description of the
// lever's path to that gear.
std::string LessonRun::State::hint_of(std::size_t index) const {
  const LessonStep& step = lesson.steps[index];
  if (!step.hint.empty() || !step.until.gear) return step.hint;
  const int from = gear_before(index);
  return from == *step.until.gear ? std::string() : describe_lever_path(gate, from, *step.until.gear);
}

bool LessonRun::State::is_off_course(const vehicle::DriveSample& sample) {
  const int wanted = lesson.steps[view.step].until.gear.value_or(haptics::kNeutralGear);
  const int gear = sample.car.gear;
  const bool astray = wanted != haptics::kNeutralGear && gear != haptics::kNeutralGear && gear != wanted &&
                      gear != gear_before(view.step);
  if (!astray) on_course = sample.time();
  return sample.time() - on_course >= kMaxOffCourseTime;
}

void LessonRun::State::end(LessonEnd how) {
  result.end = how;
  if (!all_done()) judge_time(last.time());
  add_shift(meter.finish());
  detector.finish();
  apply_errors(detector.drain_errors());
  measure_figures(result, norm);
  grade_result(lesson, result, norm);
  if (config.hints != HintStyle::summary) return;
  for (const DrivingError& error : result.errors) {
    if (error.severity != Severity::note) view.feedback.push_back(error_sentence(error));
  }
}

void LessonRun::mark_incomplete() {
  state_->result.is_complete = false;
  grade_result(state_->lesson, state_->result, state_->norm);
}

void LessonRun::mark_forceless() {
  state_->result.had_forces = false;
  mark_incomplete();
}

void LessonRun::judge_by_errors() {
  if (!is_over()) state_->norm = nullptr;
}

void LessonRun::leave() {
  if (!is_over()) state_->end(LessonEnd::left);
}

const LessonView& LessonRun::view() const noexcept {
  return state_->view;
}

bool LessonRun::is_in_shift() const noexcept {
  return state_->meter.is_open();
}

bool LessonRun::is_over() const noexcept {
  return state_->result.end != LessonEnd::running;
}

const LessonResult& LessonRun::result() const noexcept {
  return state_->result;
}

const Norm* LessonRun::norm() const noexcept {
  return state_->norm;
}

std::vector<ShiftRecord> LessonRun::drain_shifts() {
  return std::exchange(state_->new_shifts, {});
}

}  // namespace gearshift::lessons
