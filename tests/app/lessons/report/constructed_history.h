// Histories in which every number is known.
#pragma once

#include <cstdint>
#include <string>

#include "app/lessons/report/learner_history.h"
#include "tests/app/lessons/replay/constructed_record.h"

namespace gearshift::test {

inline std::string two_digits(std::int64_t number) {
  return (number < 10 ? "0" : "") + std::to_string(number);
}

// A graded run of the lesson "drill" for the task "upshift". Its number `id` also sets its day, so each run has its own
// day.
inline lessons::RunRow run_with(std::int64_t id, int shifts, double grade) {
  lessons::RunRow run;
  run.id = id;
  run.session = id;
  run.begun_at = "2026-" + two_digits(1 + id / 28 % 12) + "-" + two_digits(1 + id % 28) + "T10:00:00Z";
  lessons::LessonResult& result = run.result;
  result.lesson = "drill";
  result.task = "upshift";
  result.mode = lessons::LessonMode::by_yourself;
  result.end = lessons::LessonEnd::done;
  result.duration = 60.0;
  result.grade = grade;
  result.passed = grade >= 6.0;
  for (int i = 0; i < shifts; ++i) result.shifts.push_back(good_shift(i, 5.0 + 4.0 * i));
  return run;
}

}  // namespace gearshift::test
