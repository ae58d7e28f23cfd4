// Cards above the lesson card: the offer to set up a controller that has no effect yet, and the steps of setting it up
// with a picture of what moves.
#pragma once

#include "app/ui/panel/panel.h"

namespace gearshift::ui {

// Draws the offer or the present step along the lower edge of `room` [px]. Returns the card's upper edge [px], or the
// lower edge of `room` if there is nothing to draw.
double draw_controls_card(Controls& controls, const PanelInput& input, const ControlRect& room, PanelCommands& out);

}  // namespace gearshift::ui
