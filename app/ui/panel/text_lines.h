// Text output for the views: colour, font, wrapping, alignment.
#pragma once

#include <string>
#include <string_view>

#include "engine/ui/ui_style.h"

namespace gearshift::ui {

void put(std::string_view text, ImU32 colour);  // uses the current font
void put(std::string_view text, ImU32 colour, engine::UiFont font);
// Wraps the text at the window's right edge.
void put_wrapped(std::string_view text, ImU32 colour, engine::UiFont font = engine::UiFont::small);
// Writes the text at the right end of the previous item's line.
void put_right(std::string_view text, ImU32 colour, engine::UiFont font = engine::UiFont::small);

float width_of(std::string_view text);  // [px] in the current font
float width_of(std::string_view text, engine::UiFont font);
float button_width(std::string_view label);  // [px] in the current font

// Replaces the middle of the text by an ellipsis if the text is wider than `width` [px] in the current font.
std::string without_middle(std::string_view text, float width);
// Applies without_middle() to each word that contains a slash, i.e. to the paths in a sentence.
std::string with_short_paths(std::string_view words, float width);

// Shows the text in a tooltip whose lower edge is at `at` [px], within the screen, so that it covers nothing below.
void tooltip_above(ImVec2 at, std::string_view text);

// Continues on the previous item's line if `width` [px] fits there, otherwise on the next line.
void same_line_if_fits(float width);
// Moves the cursor so that the next item, `width` [px] wide, ends at the right edge of the previous item's line. If the
// item does not fit there, starts a new line.
void align_right(float width);

}  // namespace gearshift::ui
