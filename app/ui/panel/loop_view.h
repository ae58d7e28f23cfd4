// Timing of the haptic loop, and the time that each stage of a cycle takes.
#pragma once

#include "app/ui/panel/panel.h"

namespace gearshift::ui {

void draw_loop_view(const PanelInput& input);

}  // namespace gearshift::ui
