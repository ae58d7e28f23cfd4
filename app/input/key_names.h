// Names of keys by their place on a US keyboard, as GLFW counts them: the same on every layout, which glfwGetKeyName is
// not. "A" is the key right of Caps Lock, whatever is printed on it.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace gearshift {

std::string key_name(int key);                     // "A", "F1", "Left Shift", ...; "Key 999" for an unknown one
std::optional<int> key_of(std::string_view name);  // GLFW_KEY_...
bool types_text(int key) noexcept;                 // it may stand for a character in a text field

}  // namespace gearshift
