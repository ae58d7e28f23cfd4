// When things happened in a shift, from its record: for a timeline.
#pragma once

#include <optional>

#include "app/training/shift_record.h"

namespace gearshift {

// [s] since the shift began. What did not happen has no time. Where the pedal went down more than once: its first time
// down and its last time up.
struct ShiftTimes {
  std::optional<double> clutch_down, clutch_up;  // the pedal past its bite point
  std::optional<double> lever_left, gear_in;
  double end = 0.0;
};
ShiftTimes shift_times(const ShiftRecord& shift);

}  // namespace gearshift
