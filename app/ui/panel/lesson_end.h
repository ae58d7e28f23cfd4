// The result of a lesson run: grade, reason, and what cost points.
#pragma once

#include "app/lessons/coach/coach_view.h"
#include "app/ui/panel/controls.h"

namespace gearshift::ui {

// Draws result and driving errors side by side if they fit, and uses the rest of the window's height. Returns the
// height that must be visible [px].
float draw_lesson_end(const lessons::CoachView& coach);

}  // namespace gearshift::ui
