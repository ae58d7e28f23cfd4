// Makes untrusted text from files, keys or command lines safe to print on a terminal: one line without control
// sequences.
#pragma once

#include <string>
#include <string_view>

namespace gearshift::haptics {

// Replaces every control character (C0, DEL, or C1 encoded in UTF-8) with a question mark, or with a space if the
// character is white space.
std::string printable(std::string_view text);

// True if the text contains no control character.
bool is_printable(std::string_view text);

}  // namespace gearshift::haptics
