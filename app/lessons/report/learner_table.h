// Learners and runs as tables for a terminal.
#pragma once

#include <span>
#include <string>

#include "app/lessons/assessment/lesson.h"
#include "app/lessons/report/learner_history.h"

namespace gearshift::lessons {

std::string learner_table(std::span<const LearnerHistory> learners, std::span<const Lesson> lessons);
std::string run_table(const LearnerHistory& history);  // newest first

}  // namespace gearshift::lessons
