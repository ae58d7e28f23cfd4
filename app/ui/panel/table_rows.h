// Rows of a two-column table: name and value.
#pragma once

#include <string>

#include "app/ui/panel/palette.h"

namespace gearshift::ui {

// Call between ImGui::BeginTable(..., 2) and EndTable().
inline void table_row(const char* name, const std::string& value, ImU32 colour = ink::kText) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextDisabled("%s", name);
  ImGui::TableNextColumn();
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  ImGui::TextUnformatted(value.c_str());
  ImGui::PopStyleColor();
}

}  // namespace gearshift::ui
