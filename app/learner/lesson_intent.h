// What a step of a lesson asks a driver to do, read from its condition alone.
#pragma once

#include <cstddef>
#include <optional>

#include "app/training/lesson.h"

namespace gearshift {

enum class Motion {
  stay,   // as it is
  go,     // clutch up, and away
  bite,   // clutch to where it takes hold, the car still held
  creep,  // on the clutch, at LessonIntent::speed
  slow,   // off the throttle, on the brake
  stand   // to a stop, clutch down in time
};

struct LessonIntent {
  Motion motion = Motion::stay;
  double speed = 0.0;                // [m/s] to creep at, >= 0
  bool accelerates = false;          // go: faster, until the step is done
  bool no_throttle = false;          // the step forbids it
  bool clutch_down = false;          // and nothing else
  bool blip = false;                 // revs, and the clutch up then
  std::optional<double> brake;       // [1] all of it, where it is a call
  bool at_once = false;              // it is a call, and nobody knew when
  std::optional<double> hand_brake;  // [1]
  std::optional<bool> ignition;
  bool start = false;            // the engine must run
  std::optional<int> gear;       // that must be in now
  std::optional<int> next_gear;  // the clutch goes down for this one
};

// step: below lesson.steps.size().
LessonIntent intent_of(const Lesson& lesson, std::size_t step);

}  // namespace gearshift
