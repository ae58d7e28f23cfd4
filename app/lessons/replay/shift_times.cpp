#include "app/lessons/replay/shift_times.h"

#include <algorithm>

namespace gearshift::lessons {
namespace {

bool has(const ShiftRecord& shift, ShiftStep step) {
  return std::find(shift.steps.begin(), shift.steps.end(), step) != shift.steps.end();
}

}  // namespace

// A shift begins when the clutch or the lever moves, whichever is first. The sign of `clutch_lead` shows which one it
// was.
ShiftTimes shift_times(const ShiftRecord& shift) {
  ShiftTimes times;
  times.end = shift.end - shift.begin;
  const bool gear_is_in = shift.to != haptics::kNeutralGear && has(shift, ShiftStep::gear);
  times.lever_left = std::max(0.0, shift.clutch_lead);
  if (gear_is_in) times.gear_in = *times.lever_left + shift.lever_time;
  times.presses = static_cast<int>(std::count(shift.steps.begin(), shift.steps.end(), ShiftStep::clutch_down));
  if (times.presses == 0) return times;
  times.clutch_down = std::max(0.0, -shift.clutch_lead);
  if (times.presses > 1) return times;
  times.clutch_up = gear_is_in ? *times.gear_in + shift.clutch_lag : *times.clutch_down + shift.clutch_time;
  return times;
}

}  // namespace gearshift::lessons
