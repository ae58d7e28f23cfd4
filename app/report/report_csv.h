// A learner's history as tables for other programs: RFC 4180, one header line, units in the names, any locale.
#pragma once

#include <string>
#include <string_view>

#include "app/report/learner_history.h"

namespace gearshift {

// One field: in quotes where it holds a comma, a quote or a line end, quotes doubled.
std::string csv_field(std::string_view text);

inline constexpr int kCsvDigits = 12;  // of a number that is no count: 13.379, not 13.379000000000001

// Numbers to kCsvDigits significant digits. grade is empty where a run has none. Shifts and faults of a run count from 1,
// as on the page. A recording is named from the history's folder where it lies below that.
std::string runs_csv(const LearnerHistory& history);
std::string shifts_csv(const LearnerHistory& history);
std::string faults_csv(const LearnerHistory& history);

}  // namespace gearshift
