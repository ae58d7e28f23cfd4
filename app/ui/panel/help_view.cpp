#include "app/ui/panel/help_view.h"

#include <imgui.h>

#include <algorithm>
#include <string_view>

#include "engine/ui/ui_style.h"

namespace gearshift::ui {
namespace {

constexpr std::string_view kPanelKeys =
    "Tab\tenter the panel; next control\n"
    "Ctrl+Tab\tnext part of the panel\n"
    "Arrows, Space\tmove, press\n"
    "Escape\tleave the panel\n"
    "Ctrl+click\ttype a number into a slider\n";

void draw_key_table(const char* id, std::string_view lines) {
  if (!ImGui::BeginTable(id, 2, ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_BordersInnerH)) return;
  ImGui::TableSetupColumn("key", ImGuiTableColumnFlags_WidthFixed, 12.0f * engine::ui_em());
  ImGui::TableSetupColumn("says", ImGuiTableColumnFlags_WidthStretch);
  while (!lines.empty()) {
    const std::string_view line = lines.substr(0, lines.find('\n'));
    lines.remove_prefix(std::min(lines.size(), line.size() + 1));
    if (line.empty()) continue;
    const std::size_t tab = std::min(line.find('\t'), line.size());
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted(line.data(), line.data() + tab);
    ImGui::TableNextColumn();
    if (tab < line.size()) ImGui::TextUnformatted(line.data() + tab + 1, line.data() + line.size());
    ImGui::PopTextWrapPos();
  }
  ImGui::EndTable();
}

}  // namespace

void draw_help(bool& open, const std::string& bindings) {
  if (!open) return;
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  const float em = engine::ui_em();
  ImGui::SetNextWindowPos({0.5f * screen.x, 0.46f * screen.y}, ImGuiCond_Always, {0.5f, 0.5f});
  const float width = std::min(36.0f * em, 0.9f * screen.x);
  ImGui::SetNextWindowSizeConstraints({width, 0.0f}, {width, 0.86f * screen.y});
  constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoResize |
                                      ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                                      ImGuiWindowFlags_AlwaysAutoResize;
  if (ImGui::Begin("Controls (F1)###help", &open, kFlags)) {
    draw_key_table("bindings", bindings);
    ImGui::Spacing();
    ImGui::TextDisabled("Panel keys");
    draw_key_table("panel", kPanelKeys);
  }
  ImGui::End();
}

}  // namespace gearshift::ui
