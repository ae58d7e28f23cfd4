#include "app/ui/panel/panel_keys.h"

#include <imgui.h>
#include <imgui_internal.h>

namespace gearshift::ui {
namespace {

// Moves the keyboard focus to the window's first control, from the next frame on.
void enter(ImGuiWindow* window) {
  if (window == nullptr) return;
  ImGui::FocusWindow(window);
  ImGui::NavInitWindow(window, true);
  ImGui::GetCurrentContext()->NavDisableHighlight = false;
}

}  // namespace

void update_keyboard_focus(const char* first_window, bool shown) {
  const ImGuiContext& ui = *ImGui::GetCurrentContext();
  const bool busy = ImGui::IsAnyItemActive() || ui.NavWindowingTarget != nullptr ||
                    ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
  if (busy) return;
  if (ui.NavWindow == nullptr) {
    if (shown && ImGui::IsKeyPressed(ImGuiKey_Tab, false) && !ui.IO.KeyCtrl)
      enter(ImGui::FindWindowByName(first_window));
    return;
  }
  const bool by_mouse = ui.NavDisableHighlight, nowhere = ui.NavId == 0;
  if (by_mouse || (nowhere && ImGui::IsKeyPressed(ImGuiKey_Escape, false))) {
    ImGui::SetWindowFocus(nullptr);
  } else if (nowhere) {
    enter(ui.NavWindow);  // the user has chosen this window with Ctrl+Tab
  }
}

// Reads the context's state instead of WantCaptureKeyboard, which ImGui updates only in NewFrame.
bool panel_has_keyboard() {
  const ImGuiContext& ui = *ImGui::GetCurrentContext();
  return ui.IO.WantTextInput || ui.WantTextInputNextFrame == 1 || ui.NavWindowingTarget != nullptr ||
         (ui.NavWindow != nullptr && !ui.NavDisableHighlight);
}

}  // namespace gearshift::ui
