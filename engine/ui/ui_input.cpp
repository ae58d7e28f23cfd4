#include "engine/ui/ui_input.h"

#include <imgui.h>

#include <algorithm>
#include <iterator>

namespace gearshift {
namespace {

// GLFW_KEY_..., from glfw3.h 3.3, "Keyboard keys": stable numbers, so that this room needs no window.
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

void feed_mouse(ImGuiIO& io, const UiEvents& events) {
  constexpr float kNowhere = -3.4e38f;  // Dear ImGui's own "no mouse": -FLT_MAX
  const ImVec2 place(static_cast<float>(events.mouse.x), static_cast<float>(events.mouse.y));
  io.MousePos = events.mouse_here ? place : ImVec2(kNowhere, kNowhere);
  std::copy(events.mouse_down.begin(), events.mouse_down.end(), io.MouseDown);
  io.MouseWheel += static_cast<float>(events.scroll.y);
  io.MouseWheelH += static_cast<float>(events.scroll.x);
}

void feed_keys(ImGuiIO& io, const UiEvents& events) {
  for (const UiKey& key : events.keys) {
    if (key.key >= 0 && key.key < static_cast<int>(std::size(io.KeysDown))) io.KeysDown[key.key] = key.down;
  }
  if (!events.focused) std::fill(std::begin(io.KeysDown), std::end(io.KeysDown), false);
  io.KeyShift = events.shift;
  io.KeyCtrl = events.control;
  io.KeyAlt = events.alt;
}

}  // namespace

void map_imgui_keys() {
  for (const KeyPair& pair : kKeys) ImGui::GetIO().KeyMap[pair.imgui] = pair.glfw;
}

void feed_imgui(const UiEvents& events) {
  ImGuiIO& io = ImGui::GetIO();
  feed_mouse(io, events);
  feed_keys(io, events);
  for (const char32_t letter : events.text) io.AddInputCharacter(static_cast<unsigned>(letter));
}

}  // namespace gearshift
