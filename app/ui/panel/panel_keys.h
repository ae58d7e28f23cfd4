// Decides whether the keyboard controls the car or the panel. It controls the panel only while the user navigates in
// the panel.
#pragma once

#include <imgui.h>

#include <span>

#include "app/ui/panel/controls.h"

namespace gearshift::ui {

// Call after NewFrame and before drawing the panel's windows. Tab enters the panel at the window `first_window`, if the
// panel is shown, and then goes from control to control through all windows, with Shift backwards; Escape leaves the
// panel. Clicking the panel does not move the keyboard focus to it. `stops`: Controls::tab_stops().
void update_keyboard_focus(const char* first_window, bool shown, std::span<const TabStop> stops);

// Begins a child window whose controls the arrow keys reach as if they were its parent's.
bool begin_child(const char* name, ImVec2 size, ImGuiWindowFlags flags = 0);

// Gives the keyboard to the control that is drawn next.
void give_keyboard_to_next();

// Call between two frames. True if the panel uses the next key press.
bool panel_has_keyboard();

}  // namespace gearshift::ui
