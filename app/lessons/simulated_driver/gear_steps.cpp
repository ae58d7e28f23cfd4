#include "app/lessons/simulated_driver/gear_steps.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include "app/lessons/assessment/lever_path_text.h"

namespace gearshift::lessons {
namespace {

// Engineering values.
constexpr double kMinPressed = 0.8;      // [1]
constexpr double kClutchUp = 0.2;        // [1]
constexpr double kMaxLifted = 0.05;      // [1] throttle
constexpr double kMaxStopSpeed = 0.14;   // [m/s] 0.5 km/h
constexpr double kMinPullFactor = 1.15;  // [1] lowest engine speed after an upshift, divided by EngineSpec::lug_below
// [1] Engine speed after a downshift, divided by EngineSpec::shift_low. It is below 1, so that a downshift does not
// follow at once after an upshift.
constexpr double kDownshiftFactor = 0.85;
constexpr double kMaxShiftFactor = 0.85;   // [1] highest upshift speed as a fraction of the red line
constexpr double kSpeedReached = 0.95;     // [1] fraction of a target speed that counts as reached
constexpr double kMaxApproachTime = 90.0;  // [s]

LessonStep step(std::string prompt, DriveCondition until) {
  LessonStep s;
  s.prompt = std::move(prompt);
  s.gear = until.gear.value_or(haptics::kNeutralGear);
  s.until = until;
  return s;
}

DriveCondition clutch_down() {
  DriveCondition c;
  c.clutch_above = kMinPressed;
  return c;
}

Lesson drive_from(const LessonStart& from) {
  Lesson lesson;
  lesson.start = from;
  lesson.steps.push_back(stop_step());
  lesson.time_limit = kMaxApproachTime;
  return lesson;
}

}  // namespace

std::vector<int> forward_gears(const vehicle::CarSpec& car, const haptics::Gate& gate) {
  std::vector<int> gears;
  for (int gear = 1; gear <= haptics::kMaxGear; ++gear) {
    if (haptics::slot_of_gear(gate, gear) != haptics::kNoSlot && vehicle::shaft_per_road(car, gear) > 0.0)
      gears.push_back(gear);
  }
  return gears;
}

double upshift_speed(const vehicle::CarSpec& car, int low, int high) noexcept {
  const vehicle::EngineSpec& engine = car.engine;
  const double pulls =
      kMinPullFactor * engine.lug_below * vehicle::shaft_per_road(car, low) / vehicle::shaft_per_road(car, high);
  return std::min(std::max(engine.shift_low, pulls), kMaxShiftFactor * engine.red_line);
}

double downshift_speed(const vehicle::CarSpec& car, int low) noexcept {
  return kDownshiftFactor * car.engine.shift_low / vehicle::shaft_per_road(car, low);
}

LessonStep stop_step() {
  DriveCondition c = clutch_down();
  c.speed_above = -kMaxStopSpeed, c.speed_below = kMaxStopSpeed;
  return step("Brake, clutch down, and stop.", c);
}

LessonStep gear_step(int gear) {
  DriveCondition c;
  c.gear = gear;
  return step("Shift into " + gear_word(gear) + ".", c);
}

void add_shift(std::vector<LessonStep>& steps, int to) {
  DriveCondition down = clutch_down(), up;
  down.throttle_below = kMaxLifted;
  up.gear = to;
  up.clutch_below = kClutchUp;
  up.clutch_locked = true;
  steps.push_back(step("Off the throttle, clutch down.", down));
  steps.push_back(gear_step(to));
  steps.push_back(step("Clutch up, then throttle.", up));
}

void add_upshifts(std::vector<LessonStep>& steps, const vehicle::CarSpec& car, const std::vector<int>& gears) {
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
    steps.push_back(step("Accelerate in " + gear_word(gears[i]) + ".", faster));
  }
}

Lesson approach_lesson(const Lesson& lesson, const vehicle::CarSpec& car, const haptics::Gate& gate,
                       const LessonStart& from) {
  const LessonStart& to = lesson.start;
  Lesson approach = drive_from(from);
  if (to.running) approach.steps[0].until.running = true;
  if (to.speed > 0.0) {
    std::vector<int> gears = forward_gears(car, gate);
    std::erase_if(gears, [&](int gear) { return gear > std::max(1, to.gear); });
    add_upshifts(approach.steps, car, gears);
    DriveCondition fast;
    fast.gear = gears.back();
    fast.speed_above = kSpeedReached * to.speed;
    approach.steps.push_back(step("Accelerate.", fast));
    return approach;
  }
  approach.steps.push_back(gear_step(to.gear));
  DriveCondition parked;
  if (to.hand_brake > 0.0) parked.hand_brake_above = kSpeedReached * to.hand_brake;
  if (!to.running) parked.ignition = false;
  if (to.hand_brake > 0.0 || !to.running) approach.steps.push_back(step("Park the car.", parked));
  return approach;
}

Lesson rest_lesson(const LessonStart& from) {
  return drive_from(from);
}

}  // namespace gearshift::lessons
