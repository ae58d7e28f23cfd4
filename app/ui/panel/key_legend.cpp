#include "app/ui/panel/key_legend.h"

#include <algorithm>
#include <string>

#include "app/ui/panel/palette.h"
#include "app/ui/panel/text_lines.h"

namespace gearshift::ui {
namespace {

float cap_width(const std::string& key) {
  return width_of(key, engine::UiFont::small) + 0.7f * engine::ui_em();
}

void draw_cap(const std::string& key) {
  ImFont* font = engine::ui_font(engine::UiFont::small);
  const float em = engine::ui_em(), width = cap_width(key), height = engine::ui_font_size(font) + 0.15f * em;
  const ImVec2 low = ImGui::GetCursorScreenPos(), high(low.x + width, low.y + height);
  ImGui::Dummy({width, height});
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(low, high, ink::kRaised, 0.22f * em);
  list.AddRect(low, high, ink::kSoft, 0.22f * em);
  list.AddText(font, engine::ui_font_size(font), {low.x + 0.35f * em, low.y}, ink::kText, key.c_str());
}

}  // namespace

void draw_keys(std::span<const KeyHint> keys) {
  const float em = engine::ui_em();
  bool first = true;
  for (const KeyHint& hint : keys) {
    const float width = cap_width(hint.key) + 0.3f * em + width_of(hint.action, engine::UiFont::small);
    if (!first) {
      ImGui::SameLine(0.0f, 0.8f * em);
      if (ImGui::GetContentRegionAvail().x < width) ImGui::NewLine();
    }
    first = false;
    draw_cap(hint.key);
    ImGui::SameLine(0.0f, 0.3f * em);
    put(hint.action, ink::kSoft, engine::UiFont::small);
  }
}

void draw_restart_prompt(std::span<const KeyHint> keys) {
  const auto starter = std::find_if(
      keys.begin(), keys.end(), [](const KeyHint& hint) { return hint.action.find("starter") != std::string::npos; });
  const std::string words = starter == keys.end() ? std::string("Press the clutch, then the starter.")
                                                  : "Press the clutch, then the starter (" + starter->key + ").";
  put_wrapped(words, ink::kBad, engine::UiFont::title);
}

const char* mouse_prompt(bool mouse_moves_lever, bool panel_shown) {
  if (mouse_moves_lever) return "The mouse controls the lever (Esc releases the mouse)";
  return panel_shown ? "Click the cabin to move the lever with the mouse" : "Click to move the lever with the mouse";
}

}  // namespace gearshift::ui
