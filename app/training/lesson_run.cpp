#include "app/training/lesson_run.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/core.h>

#include "app/training/drive_condition.h"
#include "app/training/fault_rules.h"
#include "app/training/fault_watch.h"
#include "app/training/grade.h"
#include "app/training/lever_way.h"
#include "app/training/shift_meter.h"

namespace gearshift {
namespace {

constexpr double kShiftEnds = 3.0;  // [s] that a shift in progress gets once all steps are done [engineering value]
// [s] Two prompts come while the clutch is down, and each takes its reading: 0.75 s to what is expected and 0.3 s to
// read it (Green. How long does it take to stop? 2000).
constexpr double kReading = 2.0 * 1.05;
constexpr double kAstray = 3.0;  // [s] in a gear that the step is not about [engineering value]

void check_gear(const Lesson& lesson, const Gate& gate, int gear) {
  if (gear == kNeutralGear || slot_of_gear(gate, gear) != kNoSlot) return;
  throw std::invalid_argument("lesson " + lesson.key + " needs gear " + gear_name(gear) + ", which this gate lacks");
}

void check_gears(const Lesson& lesson, const Gate& gate) {
  check_gear(lesson, gate, lesson.start.gear);
  for (const LessonStep& step : lesson.steps) {
    check_gear(lesson, gate, step.gear);
    check_gear(lesson, gate, step.until.gear.value_or(kNeutralGear));
  }
  for (const LessonAbort& abort : lesson.aborts) check_gear(lesson, gate, abort.when.gear.value_or(kNeutralGear));
}

}  // namespace

struct LessonRun::State {
  State(const Lesson& a_lesson, const CarSpec& car, const Gate& a_gate, const LessonRunConfig& a_config)
      : lesson(lesson_in_car(a_lesson, car)),
        gate(a_gate),
        config(a_config),
        meter(car, gate),
        watch(car, gate, {lesson.shift_from, lesson.shift_to}, reads(a_config) ? kReading : 0.0),
        abort_held(a_lesson.aborts.size()) {}

  static bool reads(const LessonRunConfig& config) { return config.mode == LessonMode::follow_me; }
  void begin(const DriveSample& sample);
  void measure(const DriveSample& sample, double dt);
  void keep(const std::optional<ShiftRecord>& ended);
  void judge(std::vector<DriveFault> faults);
  void attribute(DriveFault& fault) const;
  int gear_wanted(int gear) const noexcept;
  double speed_wanted(int gear) const noexcept;
  bool aborts(const DriveSample& sample);
  void follow_steps(const DriveSample& sample);
  std::size_t steps_ahead(const DriveSample& sample);
  void judge_time(double time);
  void go_to(std::size_t step);
  void say_hint(const DriveSample& sample);
  bool goes_astray(const DriveSample& sample);
  int gear_before(std::size_t step) const noexcept;
  std::string hint_of(std::size_t step) const;
  void end(LessonEnd how);
  DriveProgress progress() const { return {last.car.distance - start_distance, highest - last.car.distance}; }
  bool all_done() const { return view.step >= lesson.steps.size(); }

  Lesson lesson;
  Gate gate;
  LessonRunConfig config;
  ShiftMeter meter;
  FaultWatch watch;
  HeldCondition held;
  std::vector<HeldCondition> ahead;  // of the steps that may be reached by passing over
  std::vector<HeldCondition> abort_held;
  LessonView view;
  LessonResult result;
  std::vector<ShiftRecord> fresh;
  DriveSample last;
  bool began = false;
  double start_distance = 0.0;  // [m]
  double start_slip = 0.0;      // [J]
  double highest = 0.0;         // [m] of the distance since the step began
  double step_began = 0.0;      // [s]
  double steps_done = 0.0;      // [s] when the last step was
  double on_course = 0.0;       // [s] when the gear last was one that the step may mean
};

LessonRun::LessonRun(const Lesson& lesson, const CarSpec& car, const Gate& gate, const LessonRunConfig& config) {
  check_gears(lesson, gate);
  state_ = std::make_unique<State>(lesson, car, gate, config);
  LessonResult& result = state_->result;
  result.lesson = lesson.key;
  result.task = lesson.task;
  result.mode = config.mode;
  result.guided = config.guidance > 0.0;
  state_->view.steps = lesson.steps.size();
  state_->go_to(0);
  grade_result(lesson, result);
}

LessonRun::~LessonRun() = default;

void LessonRun::add(const DriveSample& sample) {
  if (is_over()) return;
  State& state = *state_;
  if (!state.began) state.begin(sample);
  const double dt = std::clamp(sample.time() - state.last.time(), 0.0, kLongestSample);
  state.measure(sample, dt);
  state.last = sample;
  if (state.aborts(sample)) return;
  state.follow_steps(sample);
  const double time = sample.time();
  const bool shift_ends = !state.meter.is_open() && !state.meter.is_pending();
  if (state.all_done() && (shift_ends || time - state.steps_done > kShiftEnds)) {
    state.end(LessonEnd::done);
  } else if (state.result.duration >= state.lesson.time_limit) {
    state.end(LessonEnd::out_of_time);
  } else {
    state.say_hint(sample);
  }
}

void LessonRun::State::begin(const DriveSample& sample) {
  began = true;
  last = sample;
  result.begin = step_began = on_course = sample.time();
  start_distance = highest = sample.car.distance;
  start_slip = sample.car.slip_energy;
}

void LessonRun::State::measure(const DriveSample& sample, double dt) {
  result.duration = sample.time() - result.begin;
  result.slip_energy = sample.car.slip_energy - start_slip;
  const double power = sample.car.engine_torque * sample.car.engine_speed;
  result.fuel += 0.5 * dt * (last.car.engine_torque * last.car.engine_speed + power);
  result.guided = result.guided || sample.controls.guidance > 0.0;
  highest = std::max(highest, sample.car.distance);

  const std::optional<ShiftRecord> ended = meter.add(sample);
  watch.add(sample, gear_wanted(sample.car.gear), meter.is_open(), speed_wanted(sample.car.gear));
  keep(ended);
  judge(watch.take());
}

void LessonRun::State::keep(const std::optional<ShiftRecord>& ended) {
  if (!ended) return;
  watch.judge(*ended);
  result.shifts.push_back(*ended);
  fresh.push_back(*ended);
  for (DriveFault& fault : result.faults) attribute(fault);
}

// What this lesson does not look at is a note.
void LessonRun::State::judge(std::vector<DriveFault> faults) {
  for (DriveFault& fault : faults) {
    const bool counts = looks_at(lesson, fault.kind);
    if (!counts) fault.severity = Severity::note;
    attribute(fault);
    result.faults.push_back(fault);
    if (counts && config.hints != HintStyle::summary) view.said.push_back(fault_sentence(fault));
  }
  if (!faults.empty()) grade_result(lesson, result);
}

// A fault in the time of a shift is its own, whichever of the two is told first.
void LessonRun::State::attribute(DriveFault& fault) const {
  for (const ShiftRecord& record : result.shifts) {
    if (fault.shift < 0 && fault.time >= record.begin && fault.time <= record.end) fault.shift = record.number;
  }
}

// That gear, where this step or one that may be reached by passing over means it; else the one that they lead to.
int LessonRun::State::gear_wanted(int gear) const noexcept {
  int wanted = kNeutralGear;
  for (std::size_t i = view.step; !all_done() && i <= view.step + ahead.size(); ++i) {
    const int meant = lesson.steps[i].gear;
    if (meant != kNeutralGear && wanted != gear) wanted = meant;
  }
  return wanted;
}

// At which that gear is to go in, by this step or one that may be reached by passing over; 0: at any. [m/s]
double LessonRun::State::speed_wanted(int gear) const noexcept {
  for (std::size_t i = view.step; !all_done() && i <= view.step + ahead.size(); ++i) {
    if (lesson.steps[i].at && lesson.steps[i].until.gear == gear) return *lesson.steps[i].at;
  }
  return 0.0;
}

bool LessonRun::State::aborts(const DriveSample& sample) {
  for (std::size_t i = 0; i < lesson.aborts.size(); ++i) {
    if (!abort_held[i].update(lesson.aborts[i].when, sample, progress())) continue;
    result.why = lesson.aborts[i].says;
    end(LessonEnd::aborted);
    return true;
  }
  return false;
}

// A step that may be skipped is done when one behind it is: a learner who goes on is not kept waiting. But only by what
// was not so already when this step began.
void LessonRun::State::follow_steps(const DriveSample& sample) {
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

// How many steps, this one first, are passed over now; 0: none.
std::size_t LessonRun::State::steps_ahead(const DriveSample& sample) {
  std::size_t skipped = 0;
  for (std::size_t i = 0; i < ahead.size(); ++i) {
    const DriveCondition& until = lesson.steps[view.step + 1 + i].until;
    if (ahead[i].update(until, sample, progress()) && ahead[i].began_false()) skipped = i + 1;
  }
  return skipped;
}

// Of the step that is done, or was passed over: then it took until the next one was; or of the one that the lesson ended in.
void LessonRun::State::judge_time(double time) {
  const LessonStep& step = lesson.steps[view.step];
  const double took = time - step_began;
  if (!step.within || took < fault_rule(FaultKind::slow_step).raise * *step.within) return;
  DriveFault fault{FaultKind::slow_step, fault_severity(FaultKind::slow_step, took / *step.within), time, took};
  fault.step = step.prompt;
  fault.wanted = *step.within;
  judge({fault});
}

void LessonRun::State::go_to(std::size_t step) {
  view.step = step;
  view.hint.clear();
  held.reset();
  ahead.clear();
  for (std::size_t i = step; i + 1 < lesson.steps.size() && lesson.steps[i].may_be_skipped; ++i) ahead.emplace_back();
  view.guided_gear = all_done() ? kNeutralGear : lesson.steps[step].gear;
  const bool prompted = !all_done() && (config.mode == LessonMode::follow_me || lesson.steps[step].call);
  view.prompt = prompted ? lesson.steps[step].prompt : lesson.goal;
}

// Who is in a gear that the step does not mean would wait for ever: he is told, whatever the style of the hints.
void LessonRun::State::say_hint(const DriveSample& sample) {
  if (all_done()) return;
  const LessonStep& step = lesson.steps[view.step];
  if (goes_astray(sample)) {
    view.hint = fmt::format("The lesson goes on in gear {}.", gear_name(*step.until.gear));
  } else if (config.hints == HintStyle::prescriptive && sample.time() - step_began >= step.patience) {
    view.hint = hint_of(view.step);
  } else {
    view.hint.clear();
  }
}

// That the steps before this one left the car in.
int LessonRun::State::gear_before(std::size_t index) const noexcept {
  int gear = lesson.start.gear;
  for (std::size_t i = 0; i < index; ++i) gear = lesson.steps[i].until.gear.value_or(gear);
  return gear;
}

// The file's, or else for the lever its way in this gate.
std::string LessonRun::State::hint_of(std::size_t index) const {
  const LessonStep& step = lesson.steps[index];
  if (!step.hint.empty() || !step.until.gear) return step.hint;
  const int from = gear_before(index);
  return from == *step.until.gear ? std::string() : lever_way(gate, from, *step.until.gear);
}

bool LessonRun::State::goes_astray(const DriveSample& sample) {
  const int wanted = lesson.steps[view.step].until.gear.value_or(kNeutralGear);
  const int gear = sample.car.gear;
  const bool astray =
      wanted != kNeutralGear && gear != kNeutralGear && gear != wanted && gear != gear_before(view.step);
  if (!astray) on_course = sample.time();
  return sample.time() - on_course >= kAstray;
}

void LessonRun::State::end(LessonEnd how) {
  result.end = how;
  if (!all_done()) judge_time(last.time());
  keep(meter.finish());
  watch.finish();
  judge(watch.take());
  grade_result(lesson, result);
  if (config.hints != HintStyle::summary) return;
  for (const DriveFault& fault : result.faults) {
    if (fault.severity != Severity::note) view.said.push_back(fault_sentence(fault));
  }
}

void LessonRun::mark_torn() {
  state_->result.whole = false;
  grade_result(state_->lesson, state_->result);
}

void LessonRun::mark_forceless() {
  state_->result.had_forces = false;
  mark_torn();
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

std::vector<ShiftRecord> LessonRun::take_shifts() {
  return std::exchange(state_->fresh, {});
}

}  // namespace gearshift
