// Key names by position on a US keyboard, like GLFW's key codes. Unlike glfwGetKeyName(), they are the same on every
// layout: "A" is the key right of Caps Lock, whatever is printed on it.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace gearshift::ui {

std::string key_name(int key);                     // "A", "F1", "Left Shift", ...; "Key 999" for an unknown one
std::optional<int> key_of(std::string_view name);  // GLFW_KEY_...
bool types_text(int key) noexcept;                 // the key may enter a character in a text field

}  // namespace gearshift::ui
