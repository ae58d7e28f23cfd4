// Grades a lesson: every point deducted names its driving error.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "app/lessons/assessment/driving_error.h"
#include "app/lessons/assessment/lesson.h"
#include "app/lessons/assessment/lesson_result.h"

namespace gearshift::lessons {

inline constexpr double kBestGrade = 10.0;

// Points deducted for one error. [1] A note costs nothing.
double points_of(Severity severity) noexcept;

// Number of errors of severity note, minor, severe and very_severe.
std::array<std::size_t, 4> count_by_severity(std::span<const DrivingError> errors) noexcept;

// Sets deductions, grade, passed and why from end, errors, guided, had_forces and is_complete. The grade is 10 minus
// the deductions, at least 0, and 0 if the lesson was aborted or not finished in time. A guided or incomplete run has
// no deductions and a grade of 0, and it is not passed.
void grade_result(const Lesson& lesson, LessonResult& result);

// True if the grade is meaningful: the run was unguided and complete, it is over, and the learner did not leave it.
bool is_graded(const LessonResult& result) noexcept;

// Error of a run, guided or not, for the guidance policy: points for its driving errors divided by 10, at most 1; 1 if
// the lesson was not completed.
double run_error(const LessonResult& result) noexcept;

}  // namespace gearshift::lessons
