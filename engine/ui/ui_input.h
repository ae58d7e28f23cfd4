// Mouse, keys and text as plain values, for whoever has a window.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

namespace gearshift {

struct UiKey {
  int key = 0;  // as GLFW numbers them
  bool down = false;
};

// What happened since the last frame.
struct UiEvents {
  glm::dvec2 mouse{0.0};             // [px]
  bool mouse_here = true;            // false: captured by something else, or outside
  std::array<bool, 5> mouse_down{};  // now: left, right, middle, ...
  glm::dvec2 scroll{0.0};            // [lines] up +
  std::vector<UiKey> keys;           // in order
  bool shift = false, control = false, alt = false;
  std::u32string text;
  bool focused = true;  // false: the window lost it, all keys are up
};

// Into the current context's ImGuiIO, which reads it in the next NewFrame.
void feed_imgui(const UiEvents& events);

// Tells Dear ImGui which of GLFW's keys are its own: once per context.
void map_imgui_keys();

}  // namespace gearshift
