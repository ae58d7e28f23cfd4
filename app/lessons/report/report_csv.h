// Exports a learner's history as CSV: one header line, units in the column names, independent of the locale.
#pragma once

#include <string>

#include "app/lessons/report/learner_history.h"

namespace gearshift::lessons {

// The grade is empty for a run that is not graded. Shifts and driving errors of a run are numbered from 1, as on the
// page. The path of a recording below the history's folder is relative to that folder.
std::string runs_csv(const LearnerHistory& history);
std::string shifts_csv(const LearnerHistory& history);
std::string errors_csv(const LearnerHistory& history);

}  // namespace gearshift::lessons
