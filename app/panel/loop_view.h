// How well the loop keeps its time and where the time goes.
#pragma once

#include "app/panel/panel.h"

namespace gearshift {

void draw_loop_view(const PanelInput& input);

}  // namespace gearshift
