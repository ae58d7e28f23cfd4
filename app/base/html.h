// Shared by all generated pages: the style sheet and escaping of text.
#pragma once

#include <string>
#include <string_view>

namespace gearshift::base {

std::string html_text(std::string_view text);  // & < > " escaped
std::string_view html_style();                 // CSS for screen and print

}  // namespace gearshift::base
