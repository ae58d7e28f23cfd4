// Renders histories as self-contained HTML pages, for screen and print: of a learner, and of all learners.
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

// All learners: what each can do and what comes next, and how many can do each task.
std::string class_page(std::span<const LearnerHistory> learners, std::span<const Lesson> lessons);

}  // namespace gearshift::lessons
