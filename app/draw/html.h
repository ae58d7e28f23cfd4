// What every page of ours shares: one look, and text that cannot be markup.
#pragma once

#include <string>
#include <string_view>

namespace gearshift {

std::string html_text(std::string_view text);  // & < > " escaped
std::string_view html_style();                 // CSS: on screen and printed

}  // namespace gearshift
