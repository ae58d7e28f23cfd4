// The headset tab: frame timing and seat calibration.
#pragma once

#include "app/ui/panel/controls.h"
#include "app/ui/panel/panel.h"

namespace gearshift::ui {

// `input.headset` must be set. Controls: "headset_recentre", "headset_height", "headset_touch", "headset_touched",
// "headset_forget", "headset_knob", "headset_knob_right", "headset_knob_down", "headset_knob_ahead".
void draw_headset_tab(Controls& controls, const PanelInput& input, PanelCommands& out);

}  // namespace gearshift::ui
