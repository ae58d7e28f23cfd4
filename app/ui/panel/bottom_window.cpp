#include "app/ui/panel/bottom_window.h"

#include <algorithm>

#include "engine/ui/ui_style.h"

namespace gearshift::ui {

float bottom_width(const ControlRect& room, float max) {
  const float em = engine::ui_em(), all = static_cast<float>(room.max.x - room.min.x);
  return std::min(max * em, all - 2.0f * kBottomMargin * em);
}

bool begin_at_bottom(const char* name, const ControlRect& room, ImGuiWindowFlags more) {
  constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                      ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus |
                                      ImGuiWindowFlags_NoFocusOnAppearing;
  constexpr float kOpaque = 0.86f;
  const float em = engine::ui_em();
  const ImVec2 foot(0.5f * static_cast<float>(room.min.x + room.max.x),
                    static_cast<float>(room.max.y) - 0.5f * kBottomMargin * em);
  ImGui::SetNextWindowPos(foot, ImGuiCond_Always, {0.5f, 1.0f});
  ImGui::SetNextWindowBgAlpha(kOpaque);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.5f * em);
  const bool open = ImGui::Begin(name, nullptr, kFlags | more);
  ImGui::PopStyleVar();
  return open;
}

}  // namespace gearshift::ui
