#include "app/lessons/simulated_driver/lesson_intent.h"

#include <algorithm>

#include "app/lessons/simulated_driver/driver_constants.h"

namespace gearshift::lessons {
namespace {

constexpr double kMaxStopTarget = 0.4;  // [m/s] a step with a target speed below this value is a stop
constexpr double kWalkingSpeed = 1.3;   // [m/s]

Motion motion_of(const DriveCondition& c) {
  if (c.brake_above && c.clutch_above) return Motion::stay;  // begin a shift while braking
  if (c.brake_above && c.engine_above) return Motion::go;    // end it with a blip
  if (c.brake_above && (c.clutch_torque_above || c.clutch_below)) return Motion::bite;
  if (c.brake_above) return Motion::slow;
  if (c.speed_below && *c.speed_below < kMaxStopTarget) return c.brake_below ? Motion::hold : Motion::stop;
  if ((c.speed_above && c.speed_below) || c.rolled_back_above) return Motion::creep;
  if (c.speed_below) return Motion::slow;
  if (c.clutch_torque_above && c.hand_brake_above) return Motion::bite;
  if (c.clutch_above && c.speed_above) return Motion::stay;  // let the car roll
  const bool up = c.clutch_below || c.clutch_locked == true;
  if (up || c.shift_light == true || c.engine_above || c.distance_above || (c.speed_above && *c.speed_above > 0.0))
    return Motion::go;
  return Motion::stay;
}

double creep_speed(const DriveCondition& c) {
  if (!c.speed_above || !c.speed_below) return kWalkingSpeed;
  return std::min(kWalkingSpeed, 0.5 * (*c.speed_above + *c.speed_below));
}

}  // namespace

LessonIntent intent_of(const Lesson& lesson, std::size_t step) {
  const DriveCondition& c = lesson.steps[step].until;
  LessonIntent intent;
  intent.motion = motion_of(c);
  intent.speed = creep_speed(c);
  intent.no_throttle = c.throttle_below || (intent.motion != Motion::slow && c.brake_above);
  intent.clutch_down = c.clutch_above && intent.motion == Motion::stay;
  intent.blip = c.engine_above && c.clutch_locked == true && c.gear;
  intent.accelerates =
      intent.motion == Motion::go && !intent.blip &&
      (c.engine_above || c.shift_light == true || c.distance_above || (c.speed_above && *c.speed_above > 0.0));
  intent.at_once = lesson.steps[step].call && intent.motion == Motion::stop;
  const bool is_rolling = c.speed_below || c.clutch_above || c.engine_above;
  if (c.brake_above) intent.brake = is_rolling ? kHeelBrake : 1.0;
  if (intent.at_once) intent.brake = 1.0;
  if (c.hand_brake_above) intent.hand_brake = 1.0;
  if (c.hand_brake_below) intent.hand_brake = 0.0;
  intent.ignition = c.ignition;
  intent.start = c.running == true;
  intent.gear = c.gear;
  const bool has_next = intent.clutch_down && step + 1 < lesson.steps.size();
  if (has_next) intent.next_gear = lesson.steps[step + 1].until.gear;
  return intent;
}

}  // namespace gearshift::lessons
