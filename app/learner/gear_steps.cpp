#include "app/learner/gear_steps.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

namespace gearshift {
namespace {

// [engineering value]s
constexpr double kPressed = 0.8;        // [1]
constexpr double kClutchUp = 0.2;       // [1]
constexpr double kLifted = 0.05;        // [1] of the throttle
constexpr double kHalts = 0.14;         // [m/s] 0.5 km/h
constexpr double kPulls = 1.15;         // [1] of the speed below which the engine labours: a new gear begins there
constexpr double kDownAt = 0.85;        // [1] of the band's lower end: what comes up does not go down again at once
constexpr double kHighest = 0.85;       // [1] of the red line
constexpr double kNearly = 0.95;        // [1] of a speed that is to be reached
constexpr double kMostApproach = 90.0;  // [s]

LessonStep step(std::string prompt, DriveCondition until) {
  LessonStep s;
  s.prompt = std::move(prompt);
  s.gear = until.gear.value_or(kNeutralGear);
  s.until = until;
  return s;
}

DriveCondition clutch_down() {
  DriveCondition c;
  c.clutch_above = kPressed;
  return c;
}

Lesson drive_from(const LessonStart& from) {
  Lesson lesson;
  lesson.start = from;
  lesson.steps.push_back(stand_step());
  lesson.time_limit = kMostApproach;
  return lesson;
}

}  // namespace

std::vector<int> forward_gears(const CarSpec& car, const Gate& gate) {
  std::vector<int> gears;
  for (int gear = 1; gear <= kMaxGear; ++gear) {
    if (slot_of_gear(gate, gear) != kNoSlot && shaft_per_road(car, gear) > 0.0) gears.push_back(gear);
  }
  return gears;
}

double upshift_speed(const CarSpec& car, int low, int high) noexcept {
  const EngineSpec& engine = car.engine;
  const double pulls = kPulls * engine.lug_below * shaft_per_road(car, low) / shaft_per_road(car, high);
  return std::min(std::max(engine.shift_low, pulls), kHighest * engine.red_line);
}

double downshift_speed(const CarSpec& car, int low) noexcept {
  return kDownAt * car.engine.shift_low / shaft_per_road(car, low);
}

LessonStep stand_step() {
  DriveCondition c = clutch_down();
  c.speed_above = -kHalts, c.speed_below = kHalts;
  return step("Brake, clutch down, stand.", c);
}

LessonStep gear_step(int gear) {
  DriveCondition c;
  c.gear = gear;
  return step(gear == kNeutralGear ? "Lever to neutral." : std::string("Lever to ") + gear_name(gear) + ".", c);
}

void add_shift(std::vector<LessonStep>& steps, int to) {
  DriveCondition down = clutch_down(), up;
  down.throttle_below = kLifted;
  up.gear = to;
  up.clutch_below = kClutchUp;
  up.clutch_locked = true;
  steps.push_back(step("Off the throttle, clutch down.", down));
  steps.push_back(gear_step(to));
  steps.push_back(step("Clutch up, then throttle.", up));
}

void add_way_up(std::vector<LessonStep>& steps, const CarSpec& car, const std::vector<int>& gears) {
  for (std::size_t i = 0; i < gears.size(); ++i) {
    if (i == 0) {
      steps.push_back(gear_step(gears[0]));
    } else {
      add_shift(steps, gears[i]);
    }
    if (i + 1 == gears.size()) return;
    DriveCondition faster;
    faster.gear = gears[i];
    faster.engine_above = upshift_speed(car, gears[i], gears[i + 1]);
    steps.push_back(step(std::string("Accelerate in ") + gear_name(gears[i]) + ".", faster));
  }
}

Lesson approach_lesson(const Lesson& lesson, const CarSpec& car, const Gate& gate, const LessonStart& from) {
  const LessonStart& to = lesson.start;
  Lesson approach = drive_from(from);
  if (to.running) approach.steps[0].until.running = true;
  if (to.speed > 0.0) {
    std::vector<int> gears = forward_gears(car, gate);
    std::erase_if(gears, [&](int gear) { return gear > std::max(1, to.gear); });
    add_way_up(approach.steps, car, gears);
    DriveCondition fast;
    fast.gear = gears.back();
    fast.speed_above = kNearly * to.speed;
    approach.steps.push_back(step("Accelerate.", fast));
    return approach;
  }
  approach.steps.push_back(gear_step(to.gear));
  DriveCondition parked;
  if (to.hand_brake > 0.0) parked.hand_brake_above = kNearly * to.hand_brake;
  if (!to.running) parked.ignition = false;
  if (to.hand_brake > 0.0 || !to.running) approach.steps.push_back(step("Park.", parked));
  return approach;
}

Lesson rest_lesson(const LessonStart& from) {
  return drive_from(from);
}

}  // namespace gearshift
