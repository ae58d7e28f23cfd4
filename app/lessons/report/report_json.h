// Results as JSON, for scripts. The fields are those of the CSV files and of the history, with their units in the names
// (record_field.h). Gears are names, shifts count from 1, and what was not measured is left out.
#pragma once

#include <span>

#include <nlohmann/json_fwd.hpp>

#include "app/lessons/assessment/lesson.h"
#include "app/lessons/report/learner_history.h"

namespace gearshift::lessons {

nlohmann::ordered_json shift_json(const ShiftRecord& shift);
// With the sentence, and `value` and `unit` as the sentence shows them.
nlohmann::ordered_json error_json(const DrivingError& error);
// With verdict ("passed", "not passed" or "not graded"), figures, errors and shifts. `norm`: of the figures; may be null.
nlohmann::ordered_json result_json(const LessonResult& result, const Norm* norm);

// The learner's standing in each task, and the next lesson.
nlohmann::ordered_json standing_json(const LearnerHistory& history, std::span<const Lesson> lessons);
// The same with all runs, oldest first.
nlohmann::ordered_json history_json(const LearnerHistory& history, std::span<const Lesson> lessons);

}  // namespace gearshift::lessons
