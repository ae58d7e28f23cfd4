// Grades a lesson run by deducting points for driving errors.
#pragma once

#include <string_view>

#include "app/lessons/assessment/driving_error.h"
#include "app/lessons/assessment/lesson.h"
#include "app/lessons/assessment/lesson_result.h"

namespace gearshift::lessons {

inline constexpr double kBestGrade = 10.0;

// Points deducted for one error of this severity [1]; 0 for a note.
double points_of(Severity severity) noexcept;

// Computes the errors' `points` and the result's `grade`, `score`, `grading`, `passed` and `why` from its other members.
// `norm`: null if there is none.
//
// The grade is the smaller of two: 10 minus the errors' points, and 10 up to half of the norm's limit, falling to the
// pass grade at the limit and to 0 at three times the limit. It is rounded down to a tenth. A run is passed with the
// pass grade, no severe error, and no error on which the lesson fails; otherwise its grade is below the pass grade.
// An aborted lesson, or one not finished in time, has the grade 0. So has a guided or incomplete run, which loses no
// points and is not passed.
void grade_result(const Lesson& lesson, LessonResult& result, const Norm* norm = nullptr);

// The one thing to mend after a run: advice on the error or the figure that failed it; after a passed run, on the
// costliest error, else on a figure beyond its norm. Empty if there is none. `norm`: null if there is none.
std::string_view thing_to_mend(const Lesson& lesson, const LessonResult& result, const Norm* norm);

// Praises a run in one sentence, for the first of these: no errors, no grinding and no wrong slot in its shifts, no stall
// in a drive, all steps done. Empty if the run was left or nothing of it holds.
std::string_view what_was_good(const LessonResult& result) noexcept;

// Points deducted for all errors [1], which may be more than the best grade.
double points_lost(const LessonResult& result) noexcept;

// True if the grade is valid: the run is over, it was unguided and complete, and the learner did not leave it early.
bool is_graded(const LessonResult& result) noexcept;

// Overall error of a run [1], guided or not, as the input of GuidancePolicy. It is the larger of the points for the run's
// driving errors divided by 10, at most 1, and an error that grows with the score, as the points would for the same grade
// with a pass grade of 6. If the lesson was not completed, it is 1.
double run_error(const LessonResult& result) noexcept;

// The same for the hand and for the feet only: the points for their errors, or an error that grows with the distance of
// their figures beyond the norm's limit, if `norm` (may be null) judged the run. An unfinished run has only its points.
double lever_error(const LessonResult& result, const Norm* norm) noexcept;
double pedal_error(const LessonResult& result, const Norm* norm) noexcept;

}  // namespace gearshift::lessons
