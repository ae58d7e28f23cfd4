#include "app/ui/panel/panel_keys.h"

#include <imgui_internal.h>

#include <algorithm>
#include <cstddef>

namespace gearshift::ui {
namespace {

// Whether the navigation highlight is visible. In Dear ImGui 1.91.4 the variable got another name and the opposite sense.
bool is_highlight_visible(const ImGuiContext& ui) {
#if IMGUI_VERSION_NUM >= 19140
  return ui.NavCursorVisible;
#else
  return !ui.NavDisableHighlight;
#endif
}

void show_highlight(ImGuiContext& ui) {
#if IMGUI_VERSION_NUM >= 19140
  ui.NavCursorVisible = true;
#else
  ui.NavDisableHighlight = false;
#endif
}

// Moves the keyboard focus to the window's first control, from the next frame on.
void enter(ImGuiWindow* window) {
  if (window == nullptr) return;
  ImGui::FocusWindow(window);
  ImGui::NavInitWindow(window, true);
  show_highlight(*ImGui::GetCurrentContext());
}

// Moves the keyboard focus from the focused control to the next one, or with `back` to the one before. Dear ImGui 1.86
// would go only to text fields, and newer versions only through one window.
void go_to_next(std::span<const TabStop> stops, bool back) {
  if (stops.empty()) return;
  const ImGuiID focused = ImGui::GetCurrentContext()->NavId;
  const auto now = std::find_if(stops.begin(), stops.end(), [&](const TabStop& stop) { return stop.id == focused; });
  const auto count = static_cast<std::ptrdiff_t>(stops.size());
  const std::ptrdiff_t at = now == stops.end() ? (back ? 0 : -1) : now - stops.begin();
  const TabStop& next = stops[static_cast<std::size_t>((at + (back ? count - 1 : 1)) % count)];
  const ImRect place(next.min, next.max);
  ImGui::FocusWindow(next.window);
  ImGui::SetNavID(next.id, ImGuiNavLayer_Main, 0, ImGui::WindowRectAbsToRel(next.window, place));
  ImGui::ScrollToBringRectIntoView(next.window, place);
  ImGui::NavMoveRequestCancel();
  show_highlight(*ImGui::GetCurrentContext());
}

}  // namespace

void update_keyboard_focus(const char* first_window, bool shown, std::span<const TabStop> stops) {
  const ImGuiContext& ui = *ImGui::GetCurrentContext();
  const bool busy = ImGui::IsAnyItemActive() || ui.NavWindowingTarget != nullptr ||
                    ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
  if (busy) return;
  if (ui.NavWindow == nullptr) {
    if (shown && ImGui::IsKeyPressed(ImGuiKey_Tab, false) && !ui.IO.KeyCtrl)
      enter(ImGui::FindWindowByName(first_window));
    return;
  }
  const bool by_mouse = !is_highlight_visible(ui), nowhere = ui.NavId == 0;
  if (!by_mouse && !nowhere && ImGui::IsKeyPressed(ImGuiKey_Tab) && !ui.IO.KeyCtrl)
    return go_to_next(stops, ui.IO.KeyShift);
  if (by_mouse || (nowhere && ImGui::IsKeyPressed(ImGuiKey_Escape, false))) {
    ImGui::SetWindowFocus(nullptr);
  } else if (nowhere) {
    enter(ui.NavWindow);  // the user has chosen this window with Ctrl+Tab
  }
}

// The flag was moved in Dear ImGui 1.90.9.
bool begin_child(const char* name, ImVec2 size, ImGuiWindowFlags flags) {
#if IMGUI_VERSION_NUM >= 19090
  return ImGui::BeginChild(name, size, ImGuiChildFlags_NavFlattened, flags);
#else
  return ImGui::BeginChild(name, size, false, ImGuiWindowFlags_NavFlattened | flags);
#endif
}

// Dear ImGui 1.90 would ignore the control if no window had the focus, and update_keyboard_focus() takes it away after a
// click.
void give_keyboard_to_next() {
  ImGui::SetWindowFocus();
  ImGui::SetKeyboardFocusHere();
}

// Reads the context's state instead of WantCaptureKeyboard, which ImGui updates only in NewFrame.
bool panel_has_keyboard() {
  const ImGuiContext& ui = *ImGui::GetCurrentContext();
  return ui.IO.WantTextInput || ui.WantTextInputNextFrame == 1 || ui.NavWindowingTarget != nullptr ||
         (ui.NavWindow != nullptr && is_highlight_visible(ui));
}

}  // namespace gearshift::ui
