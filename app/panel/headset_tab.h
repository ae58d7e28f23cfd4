// Of a headset: its frames, and where its wearer sits.
#pragma once

#include "app/panel/controls.h"
#include "app/panel/panel.h"

namespace gearshift {

// input.headset is there. Controls: "headset_recentre", "headset_height", "headset_touch", "headset_touched",
// "headset_forget", "headset_knob", "headset_knob_right", "headset_knob_down", "headset_knob_ahead".
void draw_headset_tab(Controls& controls, const PanelInput& input, HeadsetRequests& out);

}  // namespace gearshift
