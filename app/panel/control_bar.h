// Along the bottom: the car, the warnings, the loop in a line, arm, record, and the large stop.
#pragma once

#include "app/panel/panel.h"

namespace gearshift {

// True where all of the message has room.
bool draw_control_bar(Controls& controls, const PanelInput& input, PanelRequests& out);

}  // namespace gearshift
