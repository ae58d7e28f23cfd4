// Times of the events in a shift, derived from its record, for timelines.
#pragma once

#include <optional>

#include "app/lessons/assessment/shift_record.h"

namespace gearshift::lessons {

// Times since the shift began [s]; empty for an event that did not happen. If the clutch was pressed more than once,
// only the first press has a time: the record does not contain when the pedal came up or went down again.
struct ShiftTimes {
  int presses = 0;                               // number of times the pedal went down past its bite point
  std::optional<double> clutch_down, clutch_up;  // first press; clutch_up is empty after several presses
  std::optional<double> lever_left, gear_in;
  double end = 0.0;
};
ShiftTimes shift_times(const ShiftRecord& shift);

}  // namespace gearshift::lessons
