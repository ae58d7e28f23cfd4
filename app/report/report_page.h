// A learner's history as one HTML page that needs nothing beside it: on screen and printed.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/report/chosen_shifts.h"
#include "app/report/learner_history.h"
#include "app/report/shift_recording.h"
#include "app/training/lesson.h"

namespace gearshift {

struct ShownShift {
  ChosenShift chosen;
  std::optional<ShiftRecording> recorded;
  std::string problem;  // why the recording is not shown; empty: there is none, or it is shown
};
struct ShownShifts {
  std::vector<ShownShift> worst, best;
};
// Chosen, and their recordings read. A recording's relative path is one from `folder`.
ShownShifts show_shifts(const LearnerHistory& history, const std::filesystem::path& folder);

// lessons: those that are known, in the order of teaching.
std::string report_page(const LearnerHistory& history, const ShownShifts& shifts, std::span<const Lesson> lessons);

}  // namespace gearshift
