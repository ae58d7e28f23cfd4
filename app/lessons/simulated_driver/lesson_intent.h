// The driver's task in a lesson step, derived only from the step's condition.
#pragma once

#include <cstddef>
#include <optional>

#include "app/lessons/assessment/lesson.h"

namespace gearshift::lessons {

enum class Motion {
  stay,   // no change
  go,     // clutch up and drive
  bite,   // clutch to the bite point, with the car still held by a brake
  creep,  // drive with a slipping clutch, at LessonIntent::speed
  slow,   // off the throttle, on the brake
  stop    // to a standstill, clutch down in time
};

struct LessonIntent {
  Motion motion = Motion::stay;
  double speed = 0.0;                // [m/s] for creep, >= 0
  bool accelerates = false;          // go: accelerate until the step is done
  bool no_throttle = false;          // the step forbids the throttle
  bool clutch_down = false;          // press the clutch, and do nothing else
  bool blip = false;                 // raise the revs, then release the clutch
  std::optional<double> brake;       // [1] full brake if the step is a call
  bool at_once = false;              // the step is a call, whose time is not known in advance
  std::optional<double> hand_brake;  // [1]
  std::optional<bool> ignition;
  bool start = false;            // the engine must be started
  std::optional<int> gear;       // gear to engage now
  std::optional<int> next_gear;  // gear for which the clutch is pressed
};

// Requires step < lesson.steps.size().
LessonIntent intent_of(const Lesson& lesson, std::size_t step);

}  // namespace gearshift::lessons
