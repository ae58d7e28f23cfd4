#include "app/lessons/simulated_driver/auto_driver.h"

#include <optional>
#include <string>
#include <utility>

#include "app/lessons/assessment/lesson_run.h"
#include "app/lessons/assessment/lever_path_text.h"
#include "app/lessons/simulated_driver/gear_steps.h"
#include "app/lessons/simulated_driver/simulated_driver.h"

namespace gearshift::lessons {
namespace {

constexpr double kTopGearTime = 2.0;     // [s] time driven in the highest gear (engineering value)
constexpr double kBackUpDistance = 2.0;  // [m] engineering value
constexpr double kTourLimit = 300.0;     // [s]

LessonStart start_of(const vehicle::DriveSample& sample, const LessonStart& lesson) {
  LessonStart start;
  start.gear = sample.car.gear;
  start.speed = sample.car.road_speed;
  start.slope = lesson.slope;
  start.hand_brake = sample.car.pedals.hand_brake;
  start.running = sample.car.running;
  return start;
}

LessonStep back_up_step() {
  LessonStep step;
  step.prompt = "Reverse a little, at walking pace.";
  step.gear = haptics::kReverseGear;
  step.until.gear = haptics::kReverseGear;
  step.until.rolled_back_above = kBackUpDistance;
  return step;
}

LessonStep slow_down_step(const vehicle::CarSpec& car, int high, int low) {
  LessonStep step;
  step.prompt = "Slow down in " + gear_word(high) + ".";
  step.gear = high;
  step.until.gear = high;
  step.until.speed_below = downshift_speed(car, low);
  return step;
}

}  // namespace

struct AutoDriver::State {
  enum class Phase { before, approach, lesson, rest };

  explicit State(const AutoDriverConfig& a_config) : config(a_config) {
    run.emplace(config.lesson, config.car, config.gate, kUnguidedRun);
  }

  void begin(Phase a_phase, Lesson lesson, const vehicle::DriveSample& now) {
    phase = a_phase;
    driven = std::move(lesson);
    if (phase != Phase::rest) run.emplace(driven, config.car, config.gate, kUnguidedRun);
    driver.emplace(driven, config.car, config.gate, config.skill, config.errors, config.seed + laps++, config.period);
    driver->take_over(now.controls);
  }

  // Starts the phase after the current one.
  void begin_next_phase(const vehicle::DriveSample& now) {
    const LessonStart here = start_of(now, config.lesson.start);
    if (phase == Phase::before || phase == Phase::approach) {
      begin(Phase::lesson, config.lesson, now);
    } else if (config.again) {
      begin(Phase::approach, approach_lesson(config.lesson, config.car, config.gate, here), now);
    } else {
      begin(Phase::rest, rest_lesson(here), now);
    }
  }

  static constexpr LessonRunConfig kUnguidedRun{LessonMode::by_yourself, 0.0, HintStyle::summary};

  AutoDriverConfig config;
  Phase phase = Phase::before;
  Lesson driven;
  std::optional<LessonRun> run;
  std::optional<SimulatedDriver> driver;
  std::uint64_t laps = 0;
};

AutoDriver::AutoDriver(const AutoDriverConfig& config) : state_(std::make_unique<State>(config)) {}
AutoDriver::~AutoDriver() = default;
AutoDriver::AutoDriver(AutoDriver&&) noexcept = default;

vehicle::DriverAction AutoDriver::act(const vehicle::DriveSample& sample) {
  State& state = *state_;
  if (state.phase == State::Phase::before) state.begin_next_phase(sample);
  if (state.phase == State::Phase::rest) return state.driver->act(sample, 0);
  state.run->add(sample);
  if (state.driver->has_given_up()) state.run->leave();
  if (!state.run->is_over()) return state.driver->act(sample, state.run->view().step);
  state.begin_next_phase(sample);
  return state.driver->act(sample, 0);
}

bool AutoDriver::is_over() const noexcept {
  return state_->phase == State::Phase::rest;
}

Lesson tour_lesson(const vehicle::CarSpec& car, const haptics::Gate& gate) {
  Lesson lesson;
  lesson.key = lesson.task = "tour";
  lesson.title = "Tour";
  lesson.goal = "Drive through every gear, up and down again, and reverse a little.";
  lesson.time_limit = kTourLimit;
  for (int kind = 0; kind < kErrorKindCount; ++kind) {
    // The driver of the tour does not blip on downshifts, so `rev_mismatch` is not counted.
    if (static_cast<ErrorKind>(kind) != ErrorKind::rev_mismatch) lesson.counted.push_back(static_cast<ErrorKind>(kind));
  }

  const std::vector<int> gears = forward_gears(car, gate);
  LessonStep begin = stop_step();
  begin.until.running = true;
  lesson.steps.push_back(begin);
  add_upshifts(lesson.steps, car, gears);
  if (!gears.empty()) lesson.steps.back().until.held = kTopGearTime;
  for (std::size_t i = gears.size(); i-- > 2;) {
    lesson.steps.push_back(slow_down_step(car, gears[i], gears[i - 1]));
    add_shift(lesson.steps, gears[i - 1]);
  }
  lesson.steps.push_back(stop_step());
  if (haptics::slot_of_gear(gate, haptics::kReverseGear) != haptics::kNoSlot) {
    lesson.steps.push_back(gear_step(haptics::kReverseGear));
    lesson.steps.push_back(back_up_step());
    lesson.steps.push_back(stop_step());
  }
  lesson.steps.push_back(gear_step(haptics::kNeutralGear));
  return lesson;
}

}  // namespace gearshift::lessons
