// Reads what Dear ImGui drew in its last frame: the corners of all shapes of one colour, and the texts, which are
// recovered from the positions of their glyphs in the font atlas.
#pragma once

#include <imgui.h>

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include "engine/ui/ui.h"
#include "engine/ui/ui_style.h"

namespace gearshift::test {

inline glm::dvec2 pixel_of(const ImDrawVert& vertex) {
  return {static_cast<double>(vertex.pos.x), static_cast<double>(vertex.pos.y)};
}

// [px] The corners of all shapes drawn in exactly this colour. Antialiased edges are therefore excluded. The origin is
// the upper left corner, and y points down.
inline std::vector<glm::dvec2> drawn_in(ImU32 colour) {
  std::vector<glm::dvec2> corners;
  const ImDrawData& data = *ImGui::GetDrawData();
  for (int l = 0; l < data.CmdListsCount; ++l) {
    for (const ImDrawVert& vertex : data.CmdLists[l]->VtxBuffer)
      if (vertex.col == colour) corners.push_back(pixel_of(vertex));
  }
  return corners;
}

struct PixelBox {
  glm::dvec2 min, max;
  glm::dvec2 middle() const { return 0.5 * (min + max); }
};

inline PixelBox box_of(const std::vector<glm::dvec2>& corners) {
  REQUIRE_FALSE(corners.empty());
  PixelBox box{corners.front(), corners.front()};
  for (const glm::dvec2 corner : corners) box = {glm::min(box.min, corner), glm::max(box.max, corner)};
  return box;
}

// One line of text in one colour, without its blanks, because blanks are not drawn.
struct DrawnText {
  std::string text;
  ImU32 colour = 0;
  PixelBox box;
};

inline std::string utf8(unsigned letter) {
  if (letter < 0x80u) return {static_cast<char>(letter)};
  if (letter < 0x800u) return {static_cast<char>(0xc0u | letter >> 6), static_cast<char>(0x80u | (letter & 0x3fu))};
  return {static_cast<char>(0xe0u | letter >> 12), static_cast<char>(0x80u | (letter >> 6 & 0x3fu)),
          static_cast<char>(0x80u | (letter & 0x3fu))};
}

inline std::vector<DrawnText> drawn_texts() {
  std::map<std::pair<float, float>, std::string> letters;  // the key is the glyph's upper left corner in the atlas
  for (ImFont* font : ImGui::GetIO().Fonts->Fonts) {
    for (const ImFontGlyph& glyph : engine::ui_glyphs(font).Glyphs)
      if (glyph.Visible) letters.emplace(std::pair(glyph.U0, glyph.V0), utf8(glyph.Codepoint));
  }
  std::vector<DrawnText> texts;
  const ImDrawData& data = *ImGui::GetDrawData();
  for (int l = 0; l < data.CmdListsCount; ++l) {
    const ImVector<ImDrawVert>& vertices = data.CmdLists[l]->VtxBuffer;
    for (int i = 0; i + 3 < vertices.Size; ++i) {
      const auto letter = letters.find({vertices[i].uv.x, vertices[i].uv.y});
      if (letter == letters.end() || vertices[i + 1].uv.y != vertices[i].uv.y) continue;
      const PixelBox box{pixel_of(vertices[i]), pixel_of(vertices[i + 2])};
      const bool goes_on = !texts.empty() && texts.back().colour == vertices[i].col &&
                           box.min.x > texts.back().box.min.x &&
                           box.min.x < texts.back().box.max.x + static_cast<double>(engine::ui_em()) &&
                           box.min.y < texts.back().box.max.y + 4.0 && box.max.y > texts.back().box.min.y - 4.0;
      if (!goes_on) texts.push_back({{}, vertices[i].col, box});
      DrawnText& text = texts.back();
      text.text += letter->second;
      text.box = {glm::min(text.box.min, box.min), glm::max(text.box.max, box.max)};
      i += 3;
    }
  }
  return texts;
}

inline std::string without_blanks(std::string text) {
  text.erase(std::remove(text.begin(), text.end(), ' '), text.end());
  return text;
}

inline const DrawnText& the_text(const std::vector<DrawnText>& texts, std::string_view words) {
  const std::string wanted(words);
  const auto found = std::find_if(texts.begin(), texts.end(),
                                  [&](const DrawnText& text) { return text.text == without_blanks(wanted); });
  REQUIRE_MESSAGE(found != texts.end(), "'" << wanted << "' is not on the screen");
  return *found;
}

inline bool is_drawn(const std::string& wanted) {
  const std::vector<DrawnText> texts = drawn_texts();
  return std::any_of(texts.begin(), texts.end(),
                     [&](const DrawnText& text) { return text.text == without_blanks(wanted); });
}

// True if a line of text that begins so is drawn; the rest of the text may be wrapped.
inline bool is_begun(const std::string& wanted) {
  const std::vector<DrawnText> texts = drawn_texts();
  return std::any_of(texts.begin(), texts.end(),
                     [&](const DrawnText& text) { return text.text.starts_with(without_blanks(wanted)); });
}

// The texts that are to the right of `label` on the same line, from left to right.
inline std::vector<std::string> right_of(const std::string& label) {
  std::vector<DrawnText> texts = drawn_texts();
  const PixelBox at = the_text(texts, label).box;
  std::erase_if(texts, [&](const DrawnText& text) {
    return text.box.min.x < at.max.x || text.box.middle().y < at.min.y || text.box.middle().y > at.max.y;
  });
  std::sort(texts.begin(), texts.end(),
            [](const DrawnText& a, const DrawnText& b) { return a.box.min.x < b.box.min.x; });
  std::vector<std::string> line;
  for (const DrawnText& text : texts) line.push_back(text.text);
  return line;
}

// Draws one frame with a single window of this size. `body` draws the window's content.
template <class Body>
void draw_in_window(engine::UiContext& ui, ImVec2 size, const Body& body) {
  ui.begin({size.x, size.y});
  ImGui::SetNextWindowPos({0.0f, 0.0f});
  ImGui::SetNextWindowSize(size);
  ImGui::Begin("alone", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove);
  body();
  ImGui::End();
  ui.end();
}

}  // namespace gearshift::test
