// The bar along the bottom: car, warnings, loop figures, force switch, recording, and the large STOP button.
#pragma once

#include "app/ui/panel/panel.h"

namespace gearshift::ui {

// Returns true if the whole message fits in the bar.
bool draw_control_bar(Controls& controls, const PanelInput& input, PanelCommands& out);

}  // namespace gearshift::ui
