// What a lesson came to: grade, why, and what cost points.
#pragma once

#include "app/coach/coach_view.h"
#include "app/panel/controls.h"

namespace gearshift {

// Side by side where there is room, as high as the window has left; returns the height that must be seen [px].
float draw_lesson_end(const CoachView& coach);

}  // namespace gearshift
