// Result of a lesson run: grade, driving errors and shifts.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "app/lessons/assessment/driving_error.h"
#include "app/lessons/assessment/shift_record.h"

namespace gearshift::lessons {

enum class LessonMode { follow_me, by_yourself };  // follow_me prompts every step; by_yourself shows only the goal
constexpr std::string_view to_string(LessonMode mode) noexcept {
  constexpr std::string_view kNames[] = {"follow_me", "by_yourself"};
  return kNames[static_cast<std::size_t>(mode)];
}
constexpr LessonMode last_value(LessonMode) noexcept {
  return LessonMode::by_yourself;
}

enum class LessonEnd { running, done, aborted, out_of_time, left };
constexpr std::string_view to_string(LessonEnd end) noexcept {
  constexpr std::string_view kNames[] = {"running", "done", "aborted", "out_of_time", "left"};
  return kNames[static_cast<std::size_t>(end)];
}
constexpr LessonEnd last_value(LessonEnd) noexcept {
  return LessonEnd::left;
}

struct LessonResult {
  std::string lesson;  // key
  std::string task;
  LessonMode mode = LessonMode::follow_me;
  LessonEnd end = LessonEnd::running;
  bool guided = false;      // guidance was active, so the run is not graded
  bool is_complete = true;  // no samples were lost and forces were on; otherwise the run is not graded
  bool had_forces = true;   // false if the run is incomplete because the lever had no forces
  double begin = 0.0;       // [s] on the haptic loop's clock
  double duration = 0.0;    // [s]
  double grade = 0.0;       // [1] 0 to 10: 10 minus the errors' points; 0 if not finished
  bool passed = false;
  std::string why;  // one sentence on why the run was not passed
  std::vector<DrivingError> errors;
  std::vector<ShiftRecord> shifts;
  double slip_energy = 0.0;  // [J] heat in the clutch during the whole lesson
};

// Errors and shifts are records of their own. `why` contains the effect of `had_forces`.
constexpr void each_field(FieldsOf<LessonResult> auto&& result, auto&& visit) {
  visit(RecordField{"lesson"}, result.lesson);
  visit(RecordField{"task"}, result.task);
  visit(RecordField{"mode"}, result.mode);
  visit(RecordField{"ended"}, result.end);
  visit(RecordField{"guided"}, result.guided);
  visit(RecordField{"complete"}, result.is_complete);
  visit(RecordField{"begin_s"}, result.begin);
  visit(RecordField{"duration_s"}, result.duration);
  visit(RecordField{"grade"}, result.grade);
  visit(RecordField{"passed"}, result.passed);
  visit(RecordField{"why"}, result.why);
  visit(RecordField{"slip_energy_j"}, result.slip_energy);
}

}  // namespace gearshift::lessons
