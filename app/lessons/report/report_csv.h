// Exports histories as CSV: one header line, units in the column names, independent of the locale.
#pragma once

#include <span>
#include <string>

#include "app/base/csv.h"
#include "app/lessons/assessment/lesson.h"
#include "app/lessons/report/learner_history.h"

namespace gearshift::lessons {

// The grade is empty for a run that is not graded. Shifts and driving errors of a run are numbered from 1, as on the
// page. The path of a recording below the history's folder is relative to that folder.
std::string runs_csv(const LearnerHistory& history, const base::CsvFormat& format);
std::string shifts_csv(const LearnerHistory& history, const base::CsvFormat& format);
std::string errors_csv(const LearnerHistory& history, const base::CsvFormat& format);

// One line per learner and task (app/lessons/report/standing.h).
std::string standings_csv(std::span<const LearnerHistory> learners, std::span<const Lesson> lessons,
                          const base::CsvFormat& format);

}  // namespace gearshift::lessons
