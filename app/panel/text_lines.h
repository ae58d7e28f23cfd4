// Texts as the views place them: in a colour and a font, wrapped, at the right, beside what came before.
#pragma once

#include <string>
#include <string_view>

#include "engine/ui/ui_style.h"

namespace gearshift {

void put(std::string_view text, ImU32 colour);  // in the current font
void put(std::string_view text, ImU32 colour, UiFont font);
void put_wrapped(std::string_view text, ImU32 colour, UiFont font = UiFont::small);  // to the window's right edge
void put_right(std::string_view text, ImU32 colour, UiFont font = UiFont::small);    // on the last item's line

float width_of(std::string_view text);  // [px] in the current font
float width_of(std::string_view text, UiFont font);
float button_width(std::string_view label);  // [px] in the current font

// What is longer than that [px] in the current font without its middle; and every path among these words so.
std::string without_middle(std::string_view text, float width);
std::string with_short_paths(std::string_view words, float width);

// On the last item's line where so much [px] has room there, else on the next one.
void beside(float width);
// Where what is so wide [px] has to begin to end at the right, on the last item's line; on the next one without room.
void at_right(float width);

}  // namespace gearshift
