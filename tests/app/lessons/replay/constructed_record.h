// A shift record in which every number is known.
#pragma once

#include <cstdint>

#include "app/lessons/assessment/shift_record.h"

namespace gearshift::test {

// A good shift from 2 to 3 that begins at `at` [s]. The clutch is down 0.10 s before the lever moves, the gear engages
// 0.25 s later, and the clutch is up after another 0.15 s.
inline lessons::ShiftRecord good_shift(std::int64_t number, double at) {
  lessons::ShiftRecord shift;
  shift.number = number;
  shift.begin = at;
  shift.end = at + 0.6;
  shift.from = 2;
  shift.to = 3;
  shift.clutch_time = 0.5;
  shift.lever_time = 0.25;
  shift.clutch_lead = 0.1;
  shift.clutch_lag = 0.15;
  shift.torque_gap = 0.45;
  shift.engine_speed = 230.0;
  shift.slip_energy = 850.0;
  shift.force_peak = 18.0;
  shift.steps = {lessons::ShiftStep::throttle_off, lessons::ShiftStep::clutch_down, lessons::ShiftStep::neutral,
                 lessons::ShiftStep::gear,         lessons::ShiftStep::clutch_up,   lessons::ShiftStep::throttle_on};
  return shift;
}

}  // namespace gearshift::test
