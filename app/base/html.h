// The parts that all generated pages share: style sheet and escaping of text.
#pragma once

#include <string>
#include <string_view>

namespace gearshift::base {

std::string html_text(std::string_view text);  // printable lines (haptics/files/printable.h); escapes & < > "
std::string_view html_style();                 // CSS for screen and print

}  // namespace gearshift::base
