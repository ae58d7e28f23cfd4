// Advice shown below a driving error.
#pragma once

#include <cstddef>
#include <vector>

#include "app/lessons/assessment/lesson_result.h"
#include "engine/ui/ui_style.h"

namespace gearshift::ui {

// True if advice for the error is to be shown: not for errors of severity `note`, and only once per kind of error.
// `listed`: the errors drawn above this one.
bool needs_advice(const lessons::LessonResult& result, std::size_t error, const std::vector<std::size_t>& listed);
void put_advice(lessons::ErrorKind kind);

}  // namespace gearshift::ui
