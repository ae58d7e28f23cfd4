// Makes untrusted text from files, keys or command lines safe for a terminal: one line without control sequences.
#pragma once

#include <string>
#include <string_view>

namespace gearshift::haptics {

// Replaces every control character (C0, DEL, or C1 in UTF-8) with '?', or with a space if it is white space.
std::string printable(std::string_view text);

// Whether the text contains no control character.
bool is_printable(std::string_view text);

}  // namespace gearshift::haptics
