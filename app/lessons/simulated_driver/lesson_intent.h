// The simulated driver's task in a lesson step, derived only from the step's condition.
#pragma once

#include <cstddef>
#include <optional>

#include "app/lessons/assessment/lesson.h"

namespace gearshift::lessons {

enum class Motion {
  stay,   // no change
  go,     // clutch up and drive
  bite,   // clutch at the bite point, or fully up with the engine off, with the car still held by a brake
  hold,   // keep the car still on a slope with the slipping clutch alone
  creep,  // drive with a slipping clutch, at LessonIntent::speed
  slow,   // foot off the throttle and on the brake
  stop    // stop the car; clutch down before the engine stalls
};

struct LessonIntent {
  Motion motion = Motion::stay;
  double speed = 0.0;                // [m/s] target for Motion::creep, >= 0
  bool accelerates = false;          // with Motion::go: accelerate until the step is done
  bool no_throttle = false;          // the step forbids the throttle
  bool clutch_down = false;          // press the clutch and do nothing else
  bool blip = false;                 // raise the revs, then release the clutch
  std::optional<double> brake;       // [1] brake pedal; full for an unannounced stop
  bool at_once = false;              // unannounced stop: brake as soon as the prompt appears
  std::optional<double> hand_brake;  // [1]
  std::optional<bool> ignition;
  bool start = false;            // the engine must be started
  std::optional<int> gear;       // gear to engage now
  std::optional<int> next_gear;  // gear for which the clutch is pressed
};

// The index `step` must be less than lesson.steps.size().
LessonIntent intent_of(const Lesson& lesson, std::size_t step);

}  // namespace gearshift::lessons
