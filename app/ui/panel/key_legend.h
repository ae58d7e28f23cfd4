// The key legend on the lesson card.
#pragma once

#include <string_view>
#include <vector>

#include "app/ui/panel/panel.h"

namespace gearshift::ui {

void draw_keys(const std::vector<KeyHint>& keys);  // key caps with their actions, wrapped

// Shows how to restart a stalled engine; names the starter key if one is bound.
void draw_restart_prompt(const std::vector<KeyHint>& keys);

// A prompt that says what the mouse does now and how to change that.
const char* mouse_prompt(bool mouse_moves_lever, bool panel_shown);

}  // namespace gearshift::ui
