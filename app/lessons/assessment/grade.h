// Grades a lesson run by deducting points for driving errors.
#pragma once

#include "app/lessons/assessment/driving_error.h"
#include "app/lessons/assessment/lesson.h"
#include "app/lessons/assessment/lesson_result.h"

namespace gearshift::lessons {

inline constexpr double kBestGrade = 10.0;

// Points deducted for one error of this severity [1]; 0 for a note.
double points_of(Severity severity) noexcept;

// Computes the errors' `points` and the result's `grade`, `passed` and `why` from its other members. The grade is 10
// minus the points, but at least 0. The grade is 0 if the lesson was aborted or not finished in time. A guided or
// incomplete run loses no points, has a grade of 0, and is not passed.
void grade_result(const Lesson& lesson, LessonResult& result);

// Points deducted for all errors [1], which may be more than the best grade.
double points_lost(const LessonResult& result) noexcept;

// True if the grade is valid: the run is over, it was unguided and complete, and the learner did not leave it early.
bool is_graded(const LessonResult& result) noexcept;

// Overall error of a run [1], guided or not, as the input of GuidancePolicy. It is the points for the run's driving
// errors divided by 10, at most 1. If the lesson was not completed, it is 1.
double run_error(const LessonResult& result) noexcept;

}  // namespace gearshift::lessons
