// Names of keys and of a game pad's controls. In files, a key is named after its position on a US keyboard, like GLFW's
// key codes: "A" is always the key to the right of Caps Lock. On the screen, it has the label of the user's keyboard.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace gearshift::ui {

std::string key_name(int key);                     // "A", "F1", "Left Shift", ...; "Key 999" for an unknown key
std::optional<int> key_of(std::string_view name);  // GLFW_KEY_...
// Text printed on the key: "A" on a US keyboard, "Q" on a French one; "F1", "Left Shift". The label of a US keyboard
// before GLFW is in use. Follows a change of the layout. Call on the thread that uses GLFW.
std::string key_label(int key);
bool types_text(int key) noexcept;  // true if the key may enter a character in a text field

// Names of a game pad's controls in files; the indices are GLFW's.
inline constexpr std::string_view kPadButtons[] = {"a",  "b",       "x",          "y",         "lb",
                                                   "rb", "back",    "start",      "guide",     "ls",
                                                   "rs", "dpad_up", "dpad_right", "dpad_down", "dpad_left"};
inline constexpr std::string_view kPadAxes[] = {"left_x", "left_y", "right_x", "right_y", "lt", "rt"};
std::optional<int> pad_button_of(std::string_view name);
std::optional<int> pad_axis_of(std::string_view name);

// The names that are printed on the pad: "RB" and "LT", or "R1" and "L2" on Sony's. `id`: the pad's USB id; the
// names of an Xbox pad if the maker is another.
std::string pad_button_label(int button, std::string_view id);
std::string pad_axis_label(int axis, std::string_view id);

}  // namespace gearshift::ui
