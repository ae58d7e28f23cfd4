#include "app/panel/message_note.h"

#include <algorithm>

#include "app/panel/text_lines.h"

namespace gearshift {
namespace {

constexpr float kMostNote = 40.0f, kLeastWidth = 6.0f, kMargin = 0.8f;  // [em]
constexpr float kOpaque = 0.86f;

}  // namespace

void MessageNote::draw(const std::string& message, bool told, const std::string& to_do, const ControlRect& room) {
  if (message != message_) {
    message_ = message;
    came_at_ = ImGui::GetTime();
  }
  const float em = ui_em();
  const float width = std::min(kMostNote * em, static_cast<float>(room.max.x - room.min.x) - 2.0f * kMargin * em);
  const bool is_new = ImGui::GetTime() - came_at_ < kSeen;
  const bool tells = !told && is_new && !message.empty();
  if ((!tells && to_do.empty()) || width < kLeastWidth * em) return;
  constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoNav |
                                      ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing |
                                      ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_AlwaysAutoResize;
  const float told_width = tells ? width_of(message, UiFont::small) : 0.0f;
  const float text =
      std::min(std::max(told_width, width_of(to_do, UiFont::body)), width - 2.0f * ImGui::GetStyle().WindowPadding.x);
  ImGui::SetNextWindowPos(
      {0.5f * static_cast<float>(room.min.x + room.max.x), static_cast<float>(room.min.y) + 0.5f * kMargin * em},
      ImGuiCond_Always, {0.5f, 0.0f});
  ImGui::SetNextWindowBgAlpha(kOpaque);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.5f * em);
  if (ImGui::Begin("Message", nullptr, kFlags)) {
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + text + 1.0f);
    if (!to_do.empty()) put(to_do, ink::kWarn, UiFont::body);
    if (tells) put(with_short_paths(message, text), ink::kText, UiFont::small);
    ImGui::PopTextWrapPos();
  }
  ImGui::End();
  ImGui::PopStyleVar();
}

}  // namespace gearshift
