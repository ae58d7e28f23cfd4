#include "app/ui/panel/message_note.h"

#include <algorithm>

#include "app/ui/panel/palette.h"
#include "app/ui/panel/text_lines.h"

namespace gearshift::ui {
namespace {

constexpr float kMaxNoteWidth = 40.0f, kMinNoteWidth = 6.0f, kMargin = 0.8f;  // [em]
constexpr float kOpaque = 0.86f;

}  // namespace

void MessageNote::draw(std::string_view message, bool is_in_bar, std::string_view to_do, const ControlRect& room) {
  if (message != message_) {
    message_ = message;
    arrived_at_ = ImGui::GetTime();
  }
  const float em = engine::ui_em();
  const float width = std::min(kMaxNoteWidth * em, static_cast<float>(room.max.x - room.min.x) - 2.0f * kMargin * em);
  const bool is_new = ImGui::GetTime() - arrived_at_ < kShowTime;
  const bool shows_message = !is_in_bar && is_new && !message.empty();
  if ((!shows_message && to_do.empty()) || width < kMinNoteWidth * em) return;
  constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoNav |
                                      ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing |
                                      ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_AlwaysAutoResize;
  const float message_width = shows_message ? width_of(message, engine::UiFont::small) : 0.0f;
  const float text = std::min(std::max(message_width, width_of(to_do, engine::UiFont::body)),
                              width - 2.0f * ImGui::GetStyle().WindowPadding.x);
  ImGui::SetNextWindowPos(
      {0.5f * static_cast<float>(room.min.x + room.max.x), static_cast<float>(room.min.y) + 0.5f * kMargin * em},
      ImGuiCond_Always, {0.5f, 0.0f});
  ImGui::SetNextWindowBgAlpha(kOpaque);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.5f * em);
  if (ImGui::Begin("Message", nullptr, kFlags)) {
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + text + 1.0f);
    if (!to_do.empty()) put(to_do, ink::kWarn, engine::UiFont::body);
    if (shows_message) put(with_short_paths(message, text), ink::kText, engine::UiFont::small);
    ImGui::PopTextWrapPos();
  }
  ImGui::End();
  ImGui::PopStyleVar();
}

}  // namespace gearshift::ui
