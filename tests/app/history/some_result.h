// Results of lessons with every figure different from every other.
#pragma once

#include "app/history/history.h"
#include "app/training/shift_fields.h"

namespace gearshift {

inline ShiftRecord some_shift(std::int64_t number) {
  ShiftRecord shift;
  shift.number = number;
  shift.from = static_cast<int>(number % 5);
  shift.to = shift.from + 1;
  shift.guided = number % 2 == 1;
  shift.missed = number % 3 == 1;
  shift.steps = {ShiftStep::clutch_down, ShiftStep::throttle_off, ShiftStep::gear, ShiftStep::clutch_up};
  int n = 0;
  each_figure(shift, [&](const char*, auto& value) {
    value = static_cast<std::remove_reference_t<decltype(value)>>(static_cast<double>(number) + 1.0 / ++n);
  });
  return shift;
}

inline LessonResult some_result(int shifts) {
  LessonResult result;
  result.lesson = "hill_start";
  result.task = "moving_off";
  result.mode = LessonMode::by_yourself;
  result.end = LessonEnd::done;
  result.begin = 12.5;
  result.duration = 34.25;
  result.grade = 7.5;
  result.passed = true;
  result.why = "It's \"why\"; DROP TABLE shift; --";
  result.slip_energy = 2020.5;
  result.fuel = 4321.0;
  result.faults = {{FaultKind::stall, Severity::severe, 13.5, 36.6, -1},
                   {FaultKind::rollback, Severity::minor, 14.5, 0.3, 0},
                   {FaultKind::jerk, Severity::note, 15.5, 9.0, 0},
                   {FaultKind::slow_step, Severity::note, 16.5, 4.0, 0, "Let the \"hand\" brake off.", 2.5}};
  result.deductions = {{0, 2.0}, {1, 0.5}};
  for (int i = 0; i < shifts; ++i) result.shifts.push_back(some_shift(i));
  return result;
}

}  // namespace gearshift
