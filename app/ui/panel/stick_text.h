// Texts about a physical stick: its state, and what the user has to do with it.
#pragma once

#include <string>

#include "app/ui/panel/panel.h"

namespace gearshift::ui {

// "plugged in, responds after 3.1 ms", "unplugged"
std::string format_stick_state(const StickView& stick);

// What the user has to do next; empty without a stick, or while its forces are on.
std::string stick_request(const PanelInput& input);

}  // namespace gearshift::ui
