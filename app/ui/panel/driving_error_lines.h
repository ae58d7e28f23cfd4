// Advice shown below a driving error.
#pragma once

#include <cstddef>
#include <vector>

#include "app/lessons/assessment/lesson_result.h"
#include "engine/ui/ui_style.h"

namespace gearshift::ui {

// True if the advice for an error is to be shown: not for a note, and only once per kind. listed: the errors already
// drawn above it.
bool needs_advice(const lessons::LessonResult& result, std::size_t error, const std::vector<std::size_t>& listed);
void put_advice(lessons::ErrorKind kind);

}  // namespace gearshift::ui
