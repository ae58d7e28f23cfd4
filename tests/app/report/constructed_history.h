// Histories whose every number is known.
#pragma once

#include <cstdint>
#include <string>

#include "app/report/learner_history.h"

namespace gearshift {

// A good shift from 2 to 3 that begins `at` [s]: clutch down 0.10 s before the lever leaves, gear in 0.25 s later,
// clutch up 0.15 s after it.
inline ShiftRecord good_shift(std::int64_t number, double at) {
  ShiftRecord shift;
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
  shift.steps = {ShiftStep::throttle_off, ShiftStep::clutch_down, ShiftStep::neutral,
                 ShiftStep::gear,         ShiftStep::clutch_up,   ShiftStep::throttle_on};
  return shift;
}

inline std::string two_digits(std::int64_t number) {
  return (number < 10 ? "0" : "") + std::to_string(number);
}

// A graded run of a lesson "drill" for the task "upshift", one a day.
inline ReportedRun run_with(std::int64_t id, int shifts, double grade) {
  ReportedRun run;
  run.row.id = id;
  run.row.session = id;
  run.row.begun_at = "2026-" + two_digits(1 + id / 28 % 12) + "-" + two_digits(1 + id % 28) + "T10:00:00Z";
  LessonResult& result = run.row.result;
  result.lesson = "drill";
  result.task = "upshift";
  result.mode = LessonMode::by_yourself;
  result.end = LessonEnd::done;
  result.duration = 60.0;
  result.grade = grade;
  result.passed = grade >= 6.0;
  for (int i = 0; i < shifts; ++i) result.shifts.push_back(good_shift(i, 5.0 + 4.0 * i));
  return run;
}

}  // namespace gearshift
