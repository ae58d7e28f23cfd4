#include "app/learner/auto_driver.h"

#include <optional>
#include <string>
#include <utility>

#include "app/learner/gear_steps.h"
#include "app/learner/simulated_learner.h"
#include "app/training/lesson_run.h"

namespace gearshift {
namespace {

constexpr double kTopHeld = 2.0;      // [s] in the highest gear [engineering value]
constexpr double kBackUp = 2.0;       // [m] [engineering value]
constexpr double kTourLimit = 300.0;  // [s]

LessonStart start_of(const DriveSample& sample, const LessonStart& lesson) {
  LessonStart start;
  start.gear = sample.car.gear;
  start.speed = sample.car.road_speed;
  start.slope = lesson.slope;
  start.hand_brake = sample.car.hand_brake;
  start.running = sample.car.running;
  return start;
}

LessonStep back_up_step() {
  LessonStep step;
  step.prompt = "Back up a little, at walking pace.";
  step.gear = kReverseGear;
  step.until.gear = kReverseGear;
  step.until.rolled_back_above = kBackUp;
  return step;
}

LessonStep slow_down_step(const CarSpec& car, int high, int low) {
  LessonStep step;
  step.prompt = std::string("Slow down in ") + gear_name(high) + ".";
  step.gear = high;
  step.until.gear = high;
  step.until.speed_below = downshift_speed(car, low);
  return step;
}

}  // namespace

struct AutoDriver::State {
  enum class Phase { before, approach, lesson, rest };

  explicit State(const AutoDriverConfig& a_config) : config(a_config) {
    run.emplace(config.lesson, config.car, config.gate, kAlone);
  }

  void begin(Phase a_phase, Lesson lesson, const DriveSample& now) {
    phase = a_phase;
    driven = std::move(lesson);
    if (phase != Phase::rest) run.emplace(driven, config.car, config.gate, kAlone);
    learner.emplace(driven, config.car, config.gate, config.skill, config.faults, config.seed + laps++, config.period);
    learner->take_over(now.controls);
  }

  // What comes after this phase.
  void go_on(const DriveSample& now) {
    const LessonStart here = start_of(now, config.lesson.start);
    if (phase == Phase::before || phase == Phase::approach) {
      begin(Phase::lesson, config.lesson, now);
    } else if (config.again) {
      begin(Phase::approach, approach_lesson(config.lesson, config.car, config.gate, here), now);
    } else {
      begin(Phase::rest, rest_lesson(here), now);
    }
  }

  static constexpr LessonRunConfig kAlone{LessonMode::by_yourself, 0.0, HintStyle::summary};

  AutoDriverConfig config;
  Phase phase = Phase::before;
  Lesson driven;
  std::optional<LessonRun> run;
  std::optional<SimulatedLearner> learner;
  std::uint64_t laps = 0;
};

AutoDriver::AutoDriver(const AutoDriverConfig& config) : state_(std::make_unique<State>(config)) {}
AutoDriver::~AutoDriver() = default;
AutoDriver::AutoDriver(AutoDriver&&) noexcept = default;

DriverAction AutoDriver::act(const DriveSample& sample) {
  State& state = *state_;
  if (state.phase == State::Phase::before) state.go_on(sample);
  if (state.phase == State::Phase::rest) return state.learner->act(sample, 0);
  state.run->add(sample);
  if (state.learner->gives_up()) state.run->leave();
  if (!state.run->is_over()) return state.learner->act(sample, state.run->view().step);
  state.go_on(sample);
  return state.learner->act(sample, 0);
}

bool AutoDriver::is_over() const noexcept {
  return state_->phase == State::Phase::rest;
}

Lesson tour_lesson(const CarSpec& car, const Gate& gate) {
  Lesson lesson;
  lesson.key = lesson.task = "tour";
  lesson.title = "Tour";
  lesson.goal = "Drive through every gear, up and down again, and back up a little.";
  lesson.time_limit = kTourLimit;
  for (int kind = 0; kind < kFaultKinds; ++kind) {
    // A way down without blips: that is a lesson of its own.
    if (static_cast<FaultKind>(kind) != FaultKind::rev_mismatch) lesson.counts.push_back(static_cast<FaultKind>(kind));
  }

  const std::vector<int> gears = forward_gears(car, gate);
  LessonStep begin = stand_step();
  begin.until.running = true;
  lesson.steps.push_back(begin);
  add_way_up(lesson.steps, car, gears);
  if (!gears.empty()) lesson.steps.back().until.held = kTopHeld;
  for (std::size_t i = gears.size(); i-- > 2;) {
    lesson.steps.push_back(slow_down_step(car, gears[i], gears[i - 1]));
    add_shift(lesson.steps, gears[i - 1]);
  }
  lesson.steps.push_back(stand_step());
  if (slot_of_gear(gate, kReverseGear) != kNoSlot) {
    lesson.steps.push_back(gear_step(kReverseGear));
    lesson.steps.push_back(back_up_step());
    lesson.steps.push_back(stand_step());
  }
  lesson.steps.push_back(gear_step(kNeutralGear));
  return lesson;
}

}  // namespace gearshift
