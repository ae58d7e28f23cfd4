// Exports a learner's history as CSV: RFC 4180, one header line, units in the column names, independent of the locale.
#pragma once

#include <string>
#include <string_view>

#include "app/lessons/report/learner_history.h"

namespace gearshift::lessons {

// Quotes a field that contains a comma, a quote or a line end; quotes are doubled.
std::string csv_field(std::string_view text);

// Significant digits of numbers that are not counts: 13.379, not 13.379000000000001
inline constexpr int kCsvDigits = 12;

// Numbers have kCsvDigits significant digits. grade is empty for a run that is not graded. Shifts and faults of a run
// count from 1, as on the page. The path of a recording below the history's folder is relative to it.
std::string runs_csv(const LearnerHistory& history);
std::string shifts_csv(const LearnerHistory& history);
std::string faults_csv(const LearnerHistory& history);

}  // namespace gearshift::lessons
