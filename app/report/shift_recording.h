// A shift as its drive was recorded: force and way of the lever, pedals, engine and gearbox shaft.
#pragma once

#include <filesystem>
#include <vector>

#include <glm/vec2.hpp>

#include "app/training/shift_record.h"
#include "haptics/gate/gate.h"

namespace gearshift {

struct RecordedCycle {
  double time = 0.0;          // [s] since the shift began
  double force = 0.0;         // [N] of the hand
  double clutch = 0.0;        // [1] pedal, 0 up
  double throttle = 0.0;      // [1]
  double engine_speed = 0.0;  // [rad/s]
  double shaft_speed = 0.0;   // [rad/s] of the gearbox, at the clutch
  int gear = kNeutralGear;    // whose dogs are in
  glm::dvec2 hand{0.0};       // [m] the lever point, which goes into walls
  glm::dvec2 lever{0.0};      // [m] as drawn, which does not
};

struct ClutchPress {
  double from = 0.0, to = 0.0;  // [s] since the shift began: the pedal past the car's bite point
};

struct ShiftRecording {
  Gate gate;
  double alarm = 0.0;                 // [N] above it the hand was warned
  double end = 0.0;                   // [s] of the shift, since it began
  bool has_car = false;               // else there are no speeds, and the gear is the lever's
  std::vector<RecordedCycle> cycles;  // from kAround before it to kAround after it
  std::vector<ClutchPress> presses;   // of the shift, in order; with no car behind the lever there are none
  std::vector<glm::dvec2> ideal;      // [m] the shortest way from where the gear was left to where the next one was in
};
inline constexpr double kAround = 0.3;  // [s]

// Every cycle, however long the drive is. The car is run again up to there; where it comes out otherwise than it was
// recorded (by another version of this program), the recording has no car. Throws FileError: no trace, damaged, of
// another program, its gate or car is refused, or the shift is not in it.
ShiftRecording read_shift(const std::filesystem::path& trace, const ShiftRecord& shift);

}  // namespace gearshift
