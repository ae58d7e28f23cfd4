#include "app/ui/panel/controls.h"

#include <imgui_internal.h>

#include <algorithm>

#include <fmt/format.h>

#include "app/ui/panel/palette.h"
#include "app/ui/panel/text_lines.h"
#include "engine/ui/ui_style.h"

namespace gearshift::ui {
namespace {

// Removes the last UTF-8 character of the text.
void drop_letter(std::string_view& text) {
  while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xc0u) == 0x80u) text.remove_suffix(1);
  if (!text.empty()) text.remove_suffix(1);
}

std::string with_ellipsis(std::string_view text, float width) {
  constexpr std::string_view kEllipsis = "\u2026";
  const float room = width - width_of(kEllipsis);
  while (!text.empty() && width_of(text) > room) drop_letter(text);
  return std::string(text) + std::string(kEllipsis);
}

}  // namespace

void Controls::begin_frame() noexcept {
  ++frame_;
  shortened_ = 0;
  last_stops_.swap(stops_);
  stops_.clear();
}

std::optional<ControlRect> Controls::rect(std::string_view name) const {
  const auto place = places_.find(name);
  if (place == places_.end() || place->second.frame != frame_) return std::nullopt;
  return place->second.rect;
}

void Controls::mark(std::string_view name) {
  if (const ImGuiID id = ImGui::GetItemID(); id != 0)
    stops_.push_back({id, ImGui::GetCurrentWindow(), ImGui::GetItemRectMin(), ImGui::GetItemRectMax()});
  if (!ImGui::IsItemVisible()) return;
  auto place = places_.find(name);
  if (place == places_.end()) place = places_.emplace(name, Place{}).first;
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  place->second = {{{low.x, low.y}, {high.x, high.y}}, frame_};
}

const char* Controls::join(std::string_view kind, std::string_view key) {
  joined_.assign(kind).append(": ").append(key);
  return joined_.c_str();
}

bool Controls::button(const char* name, const char* label, ImVec2 size) {
  ImGui::PushID(name);
  const bool pressed = ImGui::Button(label, size);
  ImGui::PopID();
  mark(name);
  if (size.x > 0.0f && ImGui::CalcTextSize(label, nullptr, true).x > size.x) ++shortened_;
  return pressed;
}

bool Controls::button(const char* name, const char* label, ImVec2 size, ImU32 colour) {
  ImGui::PushStyleColor(ImGuiCol_Button, colour);
  ImGui::PushStyleColor(ImGuiCol_ButtonHovered, engine::with_alpha(colour, 0.85f));
  ImGui::PushStyleColor(ImGuiCol_ButtonActive, engine::with_alpha(colour, 0.7f));
  const bool pressed = button(name, label, size);
  ImGui::PopStyleColor(3);
  return pressed;
}

bool Controls::slider(const char* key, const haptics::FileRange& range, const haptics::Display& display,
                      double& value) {
  double shown = display.factor * value;
  const double min = display.factor * range.min, max = display.factor * range.max;
  const std::string format = fmt::format("%.{}f {}", display.decimals, display.unit);
  const int flags = ImGuiSliderFlags_AlwaysClamp | (display.logarithmic ? ImGuiSliderFlags_Logarithmic : 0);
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x);
  ImGui::PushID(key);
  const bool changed = ImGui::SliderScalar("##value", ImGuiDataType_Double, &shown, &min, &max, format.c_str(), flags);
  ImGui::PopID();
  mark(key);
  if (changed) value = std::clamp(shown / display.factor, range.min, range.max);
  return changed;
}

std::optional<std::string> Controls::choice(const char* name, std::string_view current,
                                            std::span<const std::string> options, float width,
                                            std::string (*label)(std::string_view)) {
  std::optional<std::string> chosen;
  const auto text_of = [label](std::string_view option) {
    return label == nullptr ? std::string(option) : label(option);
  };
  const std::string text = text_of(current);
  const float room = width - ImGui::GetFrameHeight() - ImGui::GetStyle().FramePadding.x;
  const bool fits = width_of(text) <= room;
  if (!fits) ++shortened_;
  ImGui::PushID(name);
  ImGui::SetNextItemWidth(width);
  const bool open = ImGui::BeginCombo("##choice", fits ? text.c_str() : with_ellipsis(text, room).c_str());
  mark(name);
  if (!open && !fits && ImGui::IsItemHovered()) ImGui::SetTooltip("%s", text.c_str());
  if (open) {
    for (const std::string& option : options) {
      ImGui::PushID(option.c_str());
      if (ImGui::Selectable(text_of(option).c_str(), option == current) && option != current) chosen = option;
      ImGui::PopID();
      mark(join(name, option));
    }
    ImGui::EndCombo();
  }
  ImGui::PopID();
  return chosen;
}

void Controls::legend(ImU32 colour, std::string_view text) {
  const engine::WithFont small(engine::UiFont::small);
  const float em = engine::ui_em();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float middle = at.y + 0.5f * ImGui::GetFontSize();
  ImGui::GetWindowDrawList()->AddLine({at.x, middle}, {at.x + 0.7f * em, middle}, colour, 0.15f * em);
  ImGui::Dummy({0.7f * em, ImGui::GetFontSize()});
  ImGui::SameLine(0.0f, 0.3f * em);
  if (width_of(text) > ImGui::GetContentRegionAvail().x) ++shortened_;
  put(text, ink::kText);
}

void Controls::line(std::string_view text, float width, ImU32 colour) {
  if (width_of(text) <= width) return put(text, colour);
  const engine::WithFont small(engine::UiFont::small);
  if (width_of(text) <= width) return put(text, colour);
  ++shortened_;
  put(with_ellipsis(text, width), colour);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%.*s", static_cast<int>(text.size()), text.data());
}

}  // namespace gearshift::ui
