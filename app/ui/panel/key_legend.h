// The key legend on the lesson card.
#pragma once

#include <span>

#include "app/ui/panel/panel.h"

namespace gearshift::ui {

void draw_keys(std::span<const KeyHint> keys);  // draws key caps with their actions, in as many lines as needed

// Shows how to restart a stalled engine; names the starter key if one is bound.
void draw_restart_prompt(std::span<const KeyHint> keys);

// Returns a prompt that says what the mouse controls and how to change that.
const char* mouse_prompt(bool mouse_moves_lever, bool panel_shown);

}  // namespace gearshift::ui
