// Names of keys and pad controls. A key is named after its position on a US keyboard, like GLFW's key codes. The names
// are the same on every layout, unlike those from glfwGetKeyName(): "A" is always the key to the right of Caps Lock.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace gearshift::ui {

std::string key_name(int key);                     // "A", "F1", "Left Shift", ...; "Key 999" for an unknown key
std::optional<int> key_of(std::string_view name);  // GLFW_KEY_...
std::string key_label(int key);                    // text printed on the key: "[", "A", "F1", "Left Shift"
bool types_text(int key) noexcept;                 // true if the key may enter a character in a text field

// Names of the controls of an Xbox pad, such as "RB" and "LT". The numbers are GLFW's for any game pad.
// The name of an unknown number is text such as "button 12" or "axis 7".
std::string pad_button_label(int button);
std::string pad_axis_label(int axis);

}  // namespace gearshift::ui
