#include "app/panel/text_lines.h"

#include <algorithm>

namespace gearshift {

void put(std::string_view text, ImU32 colour) {
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  ImGui::TextUnformatted(text.data(), text.data() + text.size());
  ImGui::PopStyleColor();
}

void put(std::string_view text, ImU32 colour, UiFont font) {
  const WithFont with(font);
  put(text, colour);
}

void put_wrapped(std::string_view text, ImU32 colour, UiFont font) {
  ImGui::PushTextWrapPos(0.0f);
  put(text, colour, font);
  ImGui::PopTextWrapPos();
}

void put_right(std::string_view text, ImU32 colour, UiFont font) {
  ImGui::SameLine(std::max(0.0f, ImGui::GetWindowContentRegionMax().x - width_of(text, font)));
  put(text, colour, font);
}

float width_of(std::string_view text) {
  return ImGui::CalcTextSize(text.data(), text.data() + text.size()).x;
}

float width_of(std::string_view text, UiFont font) {
  const WithFont with(font);
  return width_of(text);
}

float button_width(std::string_view label) {
  return width_of(label) + 2.0f * ImGui::GetStyle().FramePadding.x;
}

void beside(float width) {
  ImGui::SameLine();
  if (ImGui::GetContentRegionAvail().x < width) ImGui::NewLine();
}

void at_right(float width) {
  ImGui::SameLine();
  const float room = ImGui::GetContentRegionAvail().x;
  if (room < width) {
    ImGui::NewLine();
  } else {
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + room - width);
  }
}

}  // namespace gearshift
