// When things happened in a shift, from its record: for a timeline.
#pragma once

#include <optional>

#include "app/training/shift_record.h"

namespace gearshift {

// [s] since the shift began. What did not happen has no time. A record does not say when the pedal came up, or went down
// again, where that was more than once.
struct ShiftTimes {
  int presses = 0;                               // how often the pedal went down past its bite point
  std::optional<double> clutch_down, clutch_up;  // the first time; with more than one press there is no time up
  std::optional<double> lever_left, gear_in;
  double end = 0.0;
};
ShiftTimes shift_times(const ShiftRecord& shift);

}  // namespace gearshift
