#include "engine/ui/ui_input.h"

#include <imgui.h>

#include <algorithm>
#include <iterator>

namespace gearshift::engine {
namespace {

// Key codes GLFW_KEY_... from glfw3.h 3.3, "Keyboard keys". The numbers are stable; using them directly avoids a
// dependency on GLFW.
struct KeyPair {
  ImGuiKey_ imgui;
  int glfw;
};
constexpr KeyPair kKeys[] = {
    {ImGuiKey_Tab, 258},       {ImGuiKey_LeftArrow, 263}, {ImGuiKey_RightArrow, 262}, {ImGuiKey_UpArrow, 265},
    {ImGuiKey_DownArrow, 264}, {ImGuiKey_PageUp, 266},    {ImGuiKey_PageDown, 267},   {ImGuiKey_Home, 268},
    {ImGuiKey_End, 269},       {ImGuiKey_Insert, 260},    {ImGuiKey_Delete, 261},     {ImGuiKey_Backspace, 259},
    {ImGuiKey_Space, 32},      {ImGuiKey_Enter, 257},     {ImGuiKey_Escape, 256},     {ImGuiKey_KeyPadEnter, 335},
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

// True if Dear ImGui would miss this key when it goes down and up between two frames. False for a key that writes text,
// because its letter arrives separately. But such a key counts if it is pressed with Ctrl, and Space also counts
// outside a text field.
bool is_polled_by_imgui(int key, bool control) {
  if (writes_text(key) && !control && (key != kSpace || ImGui::GetIO().WantTextInput)) return false;
  return std::any_of(std::begin(kKeys), std::end(kKeys), [&](const KeyPair& pair) { return pair.glfw == key; });
}

bool is_key_of_imgui(int key) {
  return key >= 0 && key < static_cast<int>(std::size(ImGui::GetIO().KeysDown));
}

}  // namespace

// Queues each letter after the key that typed it if there are as many letters as keys that write text. Otherwise queues
// all letters before the keys.
void UiKeyQueue::push(const UiEvents& events) {
  if (!events.focused) {
    items_.clear();
    std::fill(std::begin(ImGui::GetIO().KeysDown), std::end(ImGui::GetIO().KeysDown), false);
  }
  bool held[3] = {shift_, control_, alt_};
  const bool has_modifier_events =
      std::any_of(events.keys.begin(), events.keys.end(), [](const UiKey& key) { return modifier_of(key.key) >= 0; });
  if (!has_modifier_events) {  // without modifier key events, the states in `events` apply to all keys
    held[0] = events.shift;
    held[1] = events.control;
    held[2] = events.alt;
  }
  const auto item = [&](UiKey key, char32_t letter) { items_.push_back({key, letter, held[0], held[1], held[2]}); };
  std::size_t printable_keys = 0, next = 0;
  bool control = held[1];
  for (const UiKey& key : events.keys) {
    if (modifier_of(key.key) == 1) control = key.down;
    printable_keys += key.down && writes_text(key.key) && !control;
  }
  const bool in_order = printable_keys == events.text.size();
  if (!in_order)
    for (const char32_t letter : events.text) item({}, letter);
  for (const UiKey& key : events.keys) {
    if (const int modifier = modifier_of(key.key); modifier >= 0) held[modifier] = key.down;
    item(key, 0);
    if (in_order && key.down && writes_text(key.key) && !held[1]) item({}, events.text[next++]);
  }
  shift_ = events.shift;
  control_ = events.control;
  alt_ = events.alt;
}

// True if the item must wait for the next frame. A frame has a single state for each key and modifier, and processes
// its letters before its keys.
bool UiKeyQueue::starts_frame(const Item& item) const {
  if (changed_.empty()) return false;
  const ImGuiIO& io = ImGui::GetIO();
  if (item.letter != 0) return true;
  if (item.control != io.KeyCtrl || item.shift != io.KeyShift || item.alt != io.KeyAlt) return true;
  return std::find(changed_.begin(), changed_.end(), item.key.key) != changed_.end();
}

void UiKeyQueue::feed_next_frame() {
  ImGuiIO& io = ImGui::GetIO();
  changed_.clear();
  for (; !items_.empty() && !starts_frame(items_.front()); items_.pop_front()) {
    const Item& item = items_.front();
    io.KeyShift = item.shift;
    io.KeyCtrl = item.control;
    io.KeyAlt = item.alt;
    if (item.letter != 0) {
      io.AddInputCharacter(static_cast<unsigned>(item.letter));
    } else if (is_key_of_imgui(item.key.key)) {
      if (is_polled_by_imgui(item.key.key, item.control)) changed_.push_back(item.key.key);
      io.KeysDown[item.key.key] = item.key.down;
    }
  }
  if (!items_.empty()) return;
  const bool modifiers_match = io.KeyShift == shift_ && io.KeyCtrl == control_ && io.KeyAlt == alt_;
  if (!changed_.empty() && !modifiers_match) return;  // the modifiers change in the next frame
  io.KeyShift = shift_;
  io.KeyCtrl = control_;
  io.KeyAlt = alt_;
}

void feed_mouse(const UiEvents& events) {
  ImGuiIO& io = ImGui::GetIO();
  constexpr float kNoMousePosition = -3.4e38f;  // Dear ImGui's value for "no mouse": -FLT_MAX
  const ImVec2 position(static_cast<float>(events.mouse.x), static_cast<float>(events.mouse.y));
  io.MouseDrawCursor = events.draws_cursor;
  io.MousePos = events.has_mouse ? position : ImVec2(kNoMousePosition, kNoMousePosition);
  std::copy(events.mouse_down.begin(), events.mouse_down.end(), io.MouseDown);
  io.MouseWheel += static_cast<float>(events.scroll.y);
  io.MouseWheelH += static_cast<float>(events.scroll.x);
}

void map_imgui_keys() {
  for (const KeyPair& pair : kKeys) ImGui::GetIO().KeyMap[pair.imgui] = pair.glfw;
}

}  // namespace gearshift::engine
