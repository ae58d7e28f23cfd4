// Rows of a table of two columns: what, and how much.
#pragma once

#include <string>

#include "app/panel/palette.h"

namespace gearshift {

// Within BeginTable(..., 2).
inline void table_row(const char* name, const std::string& value, ImU32 colour = ink::kText) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextDisabled("%s", name);
  ImGui::TableNextColumn();
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  ImGui::TextUnformatted(value.c_str());
  ImGui::PopStyleColor();
}

}  // namespace gearshift
