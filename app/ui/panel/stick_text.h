// Texts about a physical stick: its state, and what the user has to do to use it.
#pragma once

#include <string>
#include <string_view>

#include "app/ui/panel/panel.h"

namespace gearshift::ui {

// "plugged in, responds after 3.1 ms", "unplugged"
std::string format_stick_state(const StickView& stick);

// Returns the next instruction for using the stick; empty if there is no stick or its forces are on.
std::string_view stick_request(const PanelInput& input);

}  // namespace gearshift::ui
