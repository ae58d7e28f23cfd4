// A shift as its drive was recorded: force and way of the lever, pedal.
#pragma once

#include <filesystem>
#include <vector>

#include <glm/vec2.hpp>

#include "app/training/shift_record.h"
#include "haptics/gate/gate.h"

namespace gearshift {

struct RecordedCycle {
  double time = 0.0;      // [s] since the shift began
  double force = 0.0;     // [N] of the hand
  double clutch = 0.0;    // [1] pedal, 0 up
  double throttle = 0.0;  // [1]
  glm::dvec2 hand{0.0};   // [m] the lever point, which goes into walls
  glm::dvec2 lever{0.0};  // [m] as drawn, which does not
};

struct RecordedShift {
  Gate gate;
  double alarm = 0.0;                 // [N] above it the hand was warned
  double end = 0.0;                   // [s] of the shift, since it began
  std::vector<RecordedCycle> cycles;  // from kAround before it to kAround after it
};
inline constexpr double kAround = 0.3;  // [s]

// Throws FileError: no trace, damaged, of another program, its gate cannot be made, or the shift is not in it.
RecordedShift read_shift(const std::filesystem::path& trace, const ShiftRecord& shift);

}  // namespace gearshift
