// The keyboard belongs to the car unless somebody walks the panel with it.
#pragma once

namespace gearshift {

// After NewFrame, before the panel's windows. A press of Tab enters at that window, where it is shown; a click does not
// keep the keyboard, and Escape gives it back.
void share_keyboard(const char* first_window, bool shown);

// Between two frames: is a key that goes down now the panel's?
bool panel_has_keyboard();

}  // namespace gearshift
