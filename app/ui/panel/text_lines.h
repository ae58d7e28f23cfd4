// Text output for the views: colour, font, wrapping, alignment.
#pragma once

#include <string>
#include <string_view>

#include "engine/ui/ui_style.h"

namespace gearshift::ui {

void put(std::string_view text, ImU32 colour);  // in the current font
void put(std::string_view text, ImU32 colour, engine::UiFont font);
void put_wrapped(std::string_view text, ImU32 colour,
                 engine::UiFont font = engine::UiFont::small);  // wraps at the window's right edge
void put_right(std::string_view text, ImU32 colour,
               engine::UiFont font = engine::UiFont::small);  // on the last item's line

float width_of(std::string_view text);  // [px] in the current font
float width_of(std::string_view text, engine::UiFont font);
float button_width(std::string_view label);  // [px] in the current font

// Text shortened in the middle to `width` [px] in the current font; the second shortens every path in a sentence.
std::string without_middle(std::string_view text, float width);
std::string with_short_paths(std::string_view words, float width);

// Continues on the last item's line if `width` [px] fits there, otherwise on the next line.
void beside(float width);
// Moves the cursor so that the next item, `width` [px] wide, ends at the right edge of the last item's line; if it does
// not fit there, starts a new line.
void align_right(float width);

}  // namespace gearshift::ui
