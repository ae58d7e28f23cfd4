// Learners and runs as tables for a terminal.
#pragma once

#include <span>
#include <string>

#include "app/report/learner_history.h"
#include "app/training/lesson.h"

namespace gearshift {

std::string learner_table(std::span<const LearnerHistory> learners, std::span<const Lesson> lessons);
std::string run_table(const LearnerHistory& history);  // newest first

}  // namespace gearshift
