// The keyboard controls the car unless the user is navigating the panel with it.
#pragma once

namespace gearshift::ui {

// Call after NewFrame and before drawing the panel's windows. Tab enters the panel at the window `first_window`, if it
// is shown; Escape leaves it. A click alone does not move the keyboard to the panel.
void update_keyboard_focus(const char* first_window, bool shown);

// Between two frames: does the panel use the next key press?
bool panel_has_keyboard();

}  // namespace gearshift::ui
