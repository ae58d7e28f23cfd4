// Makes untrusted text from files, keys or command lines safe to print on a terminal: one line without control
// sequences, in the order in which it is written.
//
// This work is based on:
// N. Boucher, R. Anderson. Trojan Source: Invisible Vulnerabilities. USENIX Security 2023 (CVE-2021-42574)
#pragma once

#include <string>
#include <string_view>

namespace gearshift::haptics {

// Replaces every control character with a question mark, or with a space if the character is white space. Control
// characters are C0, DEL, and in UTF-8 C1, line and paragraph separators, and those that change the direction of writing.
std::string printable(std::string_view text);

std::string printable_lines(std::string_view text);  // keeps line feeds

// True if the text contains no control character.
bool is_printable(std::string_view text);

}  // namespace gearshift::haptics
