#include "app/ui/panel/panel_mouse.h"

#include <imgui.h>
#include <imgui_internal.h>

namespace gearshift::ui {
namespace {

bool is_button_held(const ImGuiIO& io) {
  for (int button = 0; button < ImGuiMouseButton_COUNT; ++button)
    if (io.MouseDown[button] && io.MouseDownOwned[button]) return true;
  return false;
}

bool accepts_mouse(const ImGuiWindow& window) {
  return window.Active && !window.Hidden && (window.Flags & ImGuiWindowFlags_NoMouseInputs) == 0;
}

}  // namespace

// Checks the windows instead of WantCaptureMouse, which ImGui updates only in NewFrame.
bool panel_covers(glm::dvec2 mouse) {
  constexpr ImGuiPopupFlags kAnyPopup = ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel;
  if (is_button_held(ImGui::GetIO()) || ImGui::IsPopupOpen(nullptr, kAnyPopup)) return true;
  const ImVec2 at(static_cast<float>(mouse.x), static_cast<float>(mouse.y));
  for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows)
    if (accepts_mouse(*window) && window->OuterRectClipped.Contains(at)) return true;
  return false;
}

}  // namespace gearshift::ui
