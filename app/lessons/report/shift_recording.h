// A shift taken from the recording of its drive: lever force and path, pedals, engine and gearbox shaft.
#pragma once

#include <filesystem>
#include <vector>

#include <glm/vec2.hpp>

#include "app/lessons/assessment/shift_record.h"
#include "haptics/gate/gate.h"

namespace gearshift::lessons {

struct RecordedCycle {
  double time = 0.0;                 // [s] since the shift began
  double force = 0.0;                // [N] hand force
  double clutch = 0.0;               // [1] clutch pedal; 0: released
  double throttle = 0.0;             // [1]
  double engine_speed = 0.0;         // [rad/s]
  double shaft_speed = 0.0;          // [rad/s] gearbox input shaft, at the clutch
  int gear = haptics::kNeutralGear;  // engaged gear
  glm::dvec2 hand{0.0};              // [m] the lever point, which may penetrate walls
  glm::dvec2 lever{0.0};             // [m] the displayed lever, which never penetrates walls
};

struct ClutchPress {
  double from = 0.0, to = 0.0;  // [s] since the shift began: pedal past the bite point from `from` to `to`
};

struct ShiftRecording {
  haptics::Gate gate;
  double alarm = 0.0;                 // [N] threshold of the over-push warning
  double end = 0.0;                   // [s] duration of the shift
  bool has_car = false;               // false: no speeds, and `gear` is derived from the lever
  std::vector<RecordedCycle> cycles;  // from kRecordingMargin before the shift to kRecordingMargin after it
  std::vector<ClutchPress> presses;   // in order; empty without a car
  std::vector<glm::dvec2> ideal;  // [m] shortest path from where the old gear was left to where the new gear engaged
};
inline constexpr double kRecordingMargin = 0.3;  // [s]

// Reads every cycle of the shift, however long the drive is. The car is simulated again up to the shift. If the result
// differs from the recording, for example because a different version of this program made it, the recording counts as
// one without a car. Throws FileError if the file is not a trace, is damaged or was made by a different program, if its
// gate or car is rejected, or if it does not contain the shift.
ShiftRecording read_shift(const std::filesystem::path& trace, const ShiftRecord& shift);

}  // namespace gearshift::lessons
