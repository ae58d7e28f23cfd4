// Plots the grades of a task over its trials, with the fitted curve and its uncertainty.
#pragma once

#include <string>

#include "app/lessons/report/progress.h"

namespace gearshift::lessons {

std::string learning_svg(const TaskProgress& task);

}  // namespace gearshift::lessons
