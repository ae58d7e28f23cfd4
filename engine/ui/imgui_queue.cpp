#include "engine/ui/imgui_queue.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace gearshift::engine {

#if IMGUI_VERSION_NUM >= 18700

ImGuiQueue::ImGuiQueue() = default;

void ImGuiQueue::add_position(ImVec2 at) {
  ImGui::GetIO().AddMousePosEvent(at.x, at.y);
}

void ImGuiQueue::add_button(int button, bool down) {
  ImGui::GetIO().AddMouseButtonEvent(button, down);
}

void ImGuiQueue::add_scroll(ImVec2 lines) {
  ImGui::GetIO().AddMouseWheelEvent(lines.x, lines.y);
}

void ImGuiQueue::add_key(ImGuiKey key, bool down) {
  ImGui::GetIO().AddKeyEvent(key, down);
}

void ImGuiQueue::add_modifier(UiModifier modifier, bool down) {
#if IMGUI_VERSION_NUM >= 18900
  constexpr ImGuiKey kKeys[] = {ImGuiMod_Shift, ImGuiMod_Ctrl, ImGuiMod_Alt};
#else
  constexpr ImGuiKey kKeys[] = {ImGuiKey_ModShift, ImGuiKey_ModCtrl, ImGuiKey_ModAlt};
#endif
  add_key(kKeys[static_cast<int>(modifier)], down);
}

void ImGuiQueue::add_letter(char32_t letter) {
  ImGui::GetIO().AddInputCharacter(static_cast<unsigned>(letter));
}

void ImGuiQueue::lose_focus() {
#if IMGUI_VERSION_NUM >= 18980
  ImGui::GetIO().ClearEventsQueue();
#endif
  ImGui::GetIO().ClearInputKeys();
}

void ImGuiQueue::start_frame() {}

#else

// Gives each key the same number in KeysDown as in ImGuiKey, as in later versions.
ImGuiQueue::ImGuiQueue() {
  for (int key = 0; key < ImGuiKey_COUNT; ++key) ImGui::GetIO().KeyMap[key] = key;
}

// Rounds down, as NewFrame does: otherwise the mouse would seem to move in every frame.
void ImGuiQueue::add_position(ImVec2 at) {
  waiting_.push_back({Kind::position, 0, false, {std::floor(at.x), std::floor(at.y)}});
}

void ImGuiQueue::add_button(int button, bool down) {
  waiting_.push_back({Kind::button, button, down});
}

void ImGuiQueue::add_scroll(ImVec2 lines) {
  waiting_.push_back({Kind::scroll, 0, false, lines});
}

void ImGuiQueue::add_key(ImGuiKey key, bool down) {
  waiting_.push_back({Kind::key, key, down});
}

void ImGuiQueue::add_modifier(UiModifier modifier, bool down) {
  waiting_.push_back({Kind::modifier, static_cast<int>(modifier), down});
}

void ImGuiQueue::add_letter(char32_t letter) {
  waiting_.push_back({Kind::letter, static_cast<int>(letter)});
}

void ImGuiQueue::lose_focus() {
  ImGuiIO& io = ImGui::GetIO();
  waiting_.clear();
  std::fill(std::begin(io.KeysDown), std::end(io.KeysDown), false);
  std::fill(std::begin(io.MouseDown), std::end(io.MouseDown), false);
  io.KeyShift = io.KeyCtrl = io.KeyAlt = false;
}

void ImGuiQueue::start_frame() {
  applied_.clear();
  for (; !waiting_.empty() && !must_wait(waiting_.front()); waiting_.pop_front()) {
    if (!has_effect(waiting_.front())) continue;
    apply(waiting_.front());
    applied_.push_back(waiting_.front());
  }
}

// The state that a button, a key or a modifier sets.
bool& ImGuiQueue::state_of(const Item& item) {
  ImGuiIO& io = ImGui::GetIO();
  if (item.kind == Kind::button) return io.MouseDown[item.code];
  if (item.kind == Kind::key) return io.KeysDown[item.code];
  bool* const modifiers[] = {&io.KeyShift, &io.KeyCtrl, &io.KeyAlt};
  return *modifiers[item.code];
}

bool ImGuiQueue::has_effect(const Item& item) {
  if (item.kind == Kind::letter) return true;
  if (item.kind == Kind::scroll) return item.value.x != 0.0f || item.value.y != 0.0f;
  if (item.kind != Kind::position) return state_of(item) != item.down;
  const ImVec2 at = ImGui::GetIO().MousePos;
  return item.value.x != at.x || item.value.y != at.y;
}

void ImGuiQueue::apply(const Item& item) {
  ImGuiIO& io = ImGui::GetIO();
  if (item.kind == Kind::position) {
    io.MousePos = item.value;
  } else if (item.kind == Kind::scroll) {
    io.MouseWheelH += item.value.x;
    io.MouseWheel += item.value.y;
  } else if (item.kind == Kind::letter) {
    io.AddInputCharacter(static_cast<unsigned>(item.code));
  } else {
    state_of(item) = item.down;
  }
}

bool ImGuiQueue::has_applied(Kind kind) const {
  return std::any_of(applied_.begin(), applied_.end(), [kind](const Item& item) { return item.kind == kind; });
}

// True if the event must wait for the next frame, because Dear ImGui would not see it after the events of this frame.
// Within a frame, it evaluates position, buttons, wheel, letters and keys in an order of its own.
bool ImGuiQueue::must_wait(const Item& item) const {
  if (applied_.empty() || !has_effect(item)) return false;
  const bool repeats = std::any_of(applied_.begin(), applied_.end(), [&item](const Item& other) {
    return other.kind == item.kind && other.code == item.code;
  });
  const bool keys = has_applied(Kind::key) || has_applied(Kind::modifier), buttons = has_applied(Kind::button);
  switch (item.kind) {
    case Kind::position:
      return buttons || keys || has_applied(Kind::scroll) || has_applied(Kind::letter);
    case Kind::button:
      return repeats || has_applied(Kind::scroll);
    case Kind::scroll:
      return buttons || has_applied(Kind::position);
    case Kind::key:
    case Kind::modifier:
      return repeats || buttons || has_applied(Kind::letter);
    case Kind::letter:
      return keys || buttons || has_applied(Kind::position) || has_applied(Kind::scroll);
  }
  return false;
}

#endif

}  // namespace gearshift::engine
