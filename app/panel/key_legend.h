// Which key does what, where it is needed: on a lesson's card.
#pragma once

#include <string_view>
#include <vector>

#include "app/panel/panel.h"

namespace gearshift {

void draw_keys(const std::vector<KeyHint>& keys);  // caps with what they do, in as many lines as they need

// How an engine that stalled is started again, with the key for it where there is one.
void draw_restart_words(const std::vector<KeyHint>& keys);

// Who leads the lever, and how to change that.
const char* mouse_words(bool mouse_leads, bool panel_shown);

}  // namespace gearshift
