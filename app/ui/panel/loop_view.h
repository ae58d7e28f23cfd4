// The loop's timing and the cost of each stage.
#pragma once

#include "app/ui/panel/panel.h"

namespace gearshift::ui {

void draw_loop_view(const PanelInput& input);

}  // namespace gearshift::ui
