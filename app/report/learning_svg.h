// Grades of a task against trials, with the fitted curve and how well it is known.
#pragma once

#include <string>

#include "app/report/progress.h"

namespace gearshift {

std::string learning_svg(const TaskProgress& task);

}  // namespace gearshift
