// The key legend on the lesson card.
#pragma once

#include <string_view>
#include <vector>

#include "app/ui/panel/panel.h"

namespace gearshift::ui {

void draw_keys(const std::vector<KeyHint>& keys);  // key caps with their actions, wrapped

// Tells how to restart a stalled engine, with the starter key if there is one.
void draw_restart_prompt(const std::vector<KeyHint>& keys);

// Tells whether the mouse moves the lever, and how to change that.
const char* mouse_prompt(bool mouse_moves_lever, bool panel_shown);

}  // namespace gearshift::ui
