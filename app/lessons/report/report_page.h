// Renders a learner's history as one self-contained HTML page, for screen and print.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/lessons/assessment/lesson.h"
#include "app/lessons/report/chosen_shifts.h"
#include "app/lessons/report/learner_history.h"
#include "app/lessons/report/shift_recording.h"

namespace gearshift::lessons {

struct ShownShift {
  ChosenShift chosen;
  std::optional<ShiftRecording> recorded;
  std::string problem;  // why the recording is not shown; empty if it is shown or does not exist
};
struct ShownShifts {
  std::vector<ShownShift> worst, best;
};
// Chooses shifts and reads their recordings. A relative recording path is relative to `folder`.
ShownShifts show_shifts(const LearnerHistory& history, const std::filesystem::path& folder);

// lessons: the known lessons, in teaching order.
std::string report_page(const LearnerHistory& history, const ShownShifts& shifts, std::span<const Lesson> lessons);

}  // namespace gearshift::lessons
