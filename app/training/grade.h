// From faults to a grade: every point that is taken off names its fault.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "app/training/drive_fault.h"
#include "app/training/lesson.h"
#include "app/training/lesson_result.h"

namespace gearshift {

inline constexpr double kBestGrade = 10.0;

// Points taken off for one fault. [1] A note costs nothing.
double points_of(Severity severity) noexcept;

// Faults of note, minor, severe and very_severe.
std::array<std::size_t, 4> count_by_severity(std::span<const DriveFault> faults) noexcept;

// Fills deductions, grade, passed and why, from end, faults, guided and whole. The grade is 10 less the deductions, not
// below 0, and 0 where the lesson was broken off or not done in time; a guided or torn run has none: no deductions, grade
// 0, not passed.
void grade_result(const Lesson& lesson, LessonResult& result);

// Its grade says something of the learner: no guidance, nothing lost, over and not left.
bool is_graded(const LessonResult& result) noexcept;

// How far the run was from perfect, guided or not: points of its faults over 10, at most 1; 1 where it was not done.
// For the guidance policy; no grade.
double run_error(const LessonResult& result) noexcept;

}  // namespace gearshift
