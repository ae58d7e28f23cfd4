#include "app/panel/panel_mouse.h"

#include <imgui.h>
#include <imgui_internal.h>

namespace gearshift {
namespace {

bool holds_button(const ImGuiIO& io) {
  for (int button = 0; button < ImGuiMouseButton_COUNT; ++button)
    if (io.MouseDown[button] && io.MouseDownOwned[button]) return true;
  return false;
}

bool takes_mouse(const ImGuiWindow& window) {
  return window.Active && !window.Hidden && (window.Flags & ImGuiWindowFlags_NoMouseInputs) == 0;
}

}  // namespace

// Asked of the windows and not of ImGui's wish to capture the mouse, which is as old as the last NewFrame.
bool panel_covers(glm::dvec2 mouse) {
  constexpr ImGuiPopupFlags kAnyPopup = ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel;
  if (holds_button(ImGui::GetIO()) || ImGui::IsPopupOpen(nullptr, kAnyPopup)) return true;
  const ImVec2 at(static_cast<float>(mouse.x), static_cast<float>(mouse.y));
  for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows)
    if (takes_mouse(*window) && window->OuterRectClipped.Contains(at)) return true;
  return false;
}

}  // namespace gearshift
