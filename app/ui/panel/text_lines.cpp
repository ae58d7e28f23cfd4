#include "app/ui/panel/text_lines.h"

#include <algorithm>

#include "app/ui/panel/palette.h"

namespace gearshift::ui {

void put(std::string_view text, ImU32 colour) {
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  ImGui::TextUnformatted(text.data(), text.data() + text.size());
  ImGui::PopStyleColor();
}

void put(std::string_view text, ImU32 colour, engine::UiFont font) {
  const engine::WithFont with(font);
  put(text, colour);
}

void put_wrapped(std::string_view text, ImU32 colour, engine::UiFont font) {
  ImGui::PushTextWrapPos(0.0f);
  put(text, colour, font);
  ImGui::PopTextWrapPos();
}

void put_right(std::string_view text, ImU32 colour, engine::UiFont font) {
  ImGui::SameLine(std::max(0.0f, ImGui::GetWindowContentRegionMax().x - width_of(text, font)));
  put(text, colour, font);
}

float width_of(std::string_view text) {
  return ImGui::CalcTextSize(text.data(), text.data() + text.size()).x;
}

float width_of(std::string_view text, engine::UiFont font) {
  const engine::WithFont with(font);
  return width_of(text);
}

float button_width(std::string_view label) {
  return width_of(label) + 2.0f * ImGui::GetStyle().FramePadding.x;
}

// Never splits a UTF-8 character of several bytes.
std::string without_middle(std::string_view text, float width) {
  const auto is_continuation = [](char c) { return (static_cast<unsigned char>(c) & 0xc0u) == 0x80u; };
  constexpr std::string_view kEllipsis = "\u2026";
  constexpr float kHead = 0.2f;  // [1] fraction of the width for the beginning of a path; its end is more informative
  const float room = width - width_of(kEllipsis);
  if (width_of(text) <= width) return std::string(text);
  std::size_t end = 0;
  while (end < text.size() && width_of(text.substr(0, end + 1)) <= kHead * room) ++end;
  std::size_t begin = end;
  const float head = width_of(text.substr(0, end));
  while (begin < text.size() && head + width_of(text.substr(begin)) > room) ++begin;
  while (begin < text.size() && is_continuation(text[begin])) ++begin;
  while (end > 0 && is_continuation(text[end])) --end;
  return std::string(text.substr(0, end)) + std::string(kEllipsis) + std::string(text.substr(begin));
}

std::string with_short_paths(std::string_view words, float width) {
  std::string all;
  while (!words.empty()) {
    const std::size_t end = std::min(words.find(' '), words.size());
    const std::string_view word = words.substr(0, end);
    all += word.find('/') == std::string_view::npos ? std::string(word) : without_middle(word, width);
    if (end < words.size()) all += ' ';
    words.remove_prefix(std::min(words.size(), end + 1));
  }
  return all;
}

void tooltip_above(ImVec2 at, std::string_view text) {
  constexpr float kWidth = 26.0f;  // [em]
  const float screen = ImGui::GetIO().DisplaySize.x;
  ImGui::SetNextWindowPos(at, ImGuiCond_Always, {screen > 0.0f ? std::clamp(at.x / screen, 0.0f, 1.0f) : 0.0f, 1.0f});
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(std::min(kWidth * engine::ui_em(), 0.9f * screen));
  put(text, ink::kText);
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

void same_line_if_fits(float width) {
  ImGui::SameLine();
  if (ImGui::GetContentRegionAvail().x < width) ImGui::NewLine();
}

void align_right(float width) {
  ImGui::SameLine();
  const float room = ImGui::GetContentRegionAvail().x;
  if (room < width) {
    ImGui::NewLine();
  } else {
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + room - width);
  }
}

}  // namespace gearshift::ui
