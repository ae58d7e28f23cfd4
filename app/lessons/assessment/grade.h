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

// Sets deductions, grade, passed and why from end, errors, guided and is_complete. The grade is 10 minus the
// deductions, at least 0, and 0 if the lesson was aborted or not finished in time. A guided or incomplete run has no
// deductions, grade 0, and is not passed.
void grade_result(const Lesson& lesson, LessonResult& result);

// The grade is meaningful: no guidance, no data lost, finished and not abandoned.
bool is_graded(const LessonResult& result) noexcept;

// Distance of the run from a perfect one, guided or not: points for its errors over 10, at most 1; 1 if it was not
// finished. Used by the guidance policy; not a grade.
double run_error(const LessonResult& result) noexcept;

}  // namespace gearshift::lessons
