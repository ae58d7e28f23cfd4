#include "engine/ui/ui_queue.h"

#include <algorithm>
#include <iterator>

namespace gearshift::engine {
namespace {

#if IMGUI_VERSION_NUM >= 18700
constexpr ImGuiKey kKeypadEnter = ImGuiKey_KeypadEnter;
#else
constexpr ImGuiKey kKeypadEnter = ImGuiKey_KeyPadEnter;
#endif

// Key codes GLFW_KEY_... from glfw3.h 3.3, "Keyboard keys". The numbers are stable; using them directly avoids a
// dependency on GLFW.
struct KeyPair {
  ImGuiKey imgui;
  int glfw;
};
constexpr KeyPair kKeys[] = {
    {ImGuiKey_Tab, 258},       {ImGuiKey_LeftArrow, 263}, {ImGuiKey_RightArrow, 262}, {ImGuiKey_UpArrow, 265},
    {ImGuiKey_DownArrow, 264}, {ImGuiKey_PageUp, 266},    {ImGuiKey_PageDown, 267},   {ImGuiKey_Home, 268},
    {ImGuiKey_End, 269},       {ImGuiKey_Insert, 260},    {ImGuiKey_Delete, 261},     {ImGuiKey_Backspace, 259},
    {ImGuiKey_Space, 32},      {ImGuiKey_Enter, 257},     {ImGuiKey_Escape, 256},     {kKeypadEnter, 335},
    {ImGuiKey_A, 65},          {ImGuiKey_C, 67},          {ImGuiKey_V, 86},           {ImGuiKey_X, 88},
    {ImGuiKey_Y, 89},          {ImGuiKey_Z, 90}};

constexpr int kSpace = 32, kLastPrintable = 96;  // GLFW_KEY_SPACE, GLFW_KEY_GRAVE_ACCENT
constexpr int kLeftShift = 340, kRightShift = 344;

// Returns 0 for shift, 1 for control, 2 for alt, and -1 for other keys.
int modifier_of(int key) {
  const int side = key >= kRightShift ? kRightShift : kLeftShift;
  return key >= side && key < side + 3 ? key - side : -1;
}

bool writes_text(int key) {
  return key >= kSpace && key <= kLastPrintable;
}

ImVec2 pixel(glm::dvec2 at) {
  return {static_cast<float>(at.x), static_cast<float>(at.y)};
}

}  // namespace

void UiQueue::push(const UiEvents& events) {
  if (focused_ && !events.focused) {
    queue_.lose_focus();
    control_ = false;
  }
  focused_ = events.focused;
  for (const UiEvent& event : events.steps) std::visit([this](const auto& e) { push(e); }, event);
  constexpr float kNoMousePosition = -3.4e38f;  // Dear ImGui's value for "no mouse": -FLT_MAX
  ImGui::GetIO().MouseDrawCursor = events.draws_cursor;
  queue_.add_position(events.has_mouse ? pixel(events.mouse) : ImVec2(kNoMousePosition, kNoMousePosition));
  for (int button = 0; button < static_cast<int>(events.mouse_down.size()); ++button)
    queue_.add_button(button, events.mouse_down[static_cast<std::size_t>(button)]);
}

void UiQueue::push(const UiButton& event) {
  queue_.add_position(pixel(event.at));
  queue_.add_button(event.button, event.down);
}

void UiQueue::push(const UiScroll& event) {
  queue_.add_position(pixel(event.at));
  queue_.add_scroll(pixel(event.lines));
}

// A key that writes text is not pressed for Dear ImGui, because its letter arrives separately, and the letter would
// have to wait for the next frame. But such a key counts if it is pressed with Ctrl, and Space also counts outside a
// text field.
void UiQueue::push(const UiKey& event) {
  if (const int modifier = modifier_of(event.key); modifier >= 0) {
    if (modifier == static_cast<int>(UiModifier::control)) control_ = event.down;
    queue_.add_modifier(static_cast<UiModifier>(modifier), event.down);
    return;
  }
  const bool is_letter_only =
      writes_text(event.key) && !control_ && (event.key != kSpace || ImGui::GetIO().WantTextInput);
  if (event.down && is_letter_only) return;
  const auto* const found =
      std::find_if(std::begin(kKeys), std::end(kKeys), [&](const KeyPair& pair) { return pair.glfw == event.key; });
  if (found != std::end(kKeys)) queue_.add_key(found->imgui, event.down);
}

}  // namespace gearshift::engine
