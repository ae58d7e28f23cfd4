#include "app/panel/key_legend.h"

#include <algorithm>
#include <string>

#include "app/panel/palette.h"
#include "app/panel/text_lines.h"

namespace gearshift {
namespace {

float cap_width(const std::string& key) {
  return width_of(key, UiFont::small) + 0.7f * ui_em();
}

void draw_cap(const std::string& key) {
  ImFont* font = ui_font(UiFont::small);
  const float em = ui_em(), width = cap_width(key), height = font->FontSize + 0.15f * em;
  const ImVec2 low = ImGui::GetCursorScreenPos(), high(low.x + width, low.y + height);
  ImGui::Dummy({width, height});
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(low, high, ink::kRaised, 0.22f * em);
  list.AddRect(low, high, ink::kSoft, 0.22f * em);
  list.AddText(font, font->FontSize, {low.x + 0.35f * em, low.y}, ink::kText, key.c_str());
}

}  // namespace

void draw_keys(const std::vector<KeyHint>& keys) {
  const float em = ui_em();
  bool first = true;
  for (const KeyHint& hint : keys) {
    const float width = cap_width(hint.key) + 0.3f * em + width_of(hint.does, UiFont::small);
    if (!first) {
      ImGui::SameLine(0.0f, 0.8f * em);
      if (ImGui::GetContentRegionAvail().x < width) ImGui::NewLine();
    }
    first = false;
    draw_cap(hint.key);
    ImGui::SameLine(0.0f, 0.3f * em);
    put(hint.does, ink::kSoft, UiFont::small);
  }
}

void draw_restart_words(const std::vector<KeyHint>& keys) {
  const auto starter = std::find_if(keys.begin(), keys.end(),
                                    [](const KeyHint& hint) { return hint.does.find("starter") != std::string::npos; });
  const std::string words = starter == keys.end() ? std::string("Clutch down, then starter.")
                                                  : "Clutch down, then starter [" + starter->key + "]";
  put_wrapped(words, ink::kBad, UiFont::title);
}

const char* mouse_words(bool mouse_leads, bool panel_shown) {
  if (mouse_leads) return "The mouse leads the lever: Esc frees it";
  return panel_shown ? "Click beside the panel: the mouse leads the lever"
                     : "Click into the cabin: the mouse leads the lever";
}

}  // namespace gearshift
