// Text from a file, a key or a command line as it may be shown on a terminal: one line, nothing obeyed.
#pragma once

#include <string>
#include <string_view>

namespace gearshift {

// Every control character, C0, DEL or C1 in UTF-8, becomes one visible '?' (a space where it is white space).
std::string printable(std::string_view text);

// Holds no control character.
bool is_printable(std::string_view text);

}  // namespace gearshift
