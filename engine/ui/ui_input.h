// Mouse, keys and text as plain values, independent of the window library and of Dear ImGui.
#pragma once

#include <array>
#include <variant>
#include <vector>

#include <glm/vec2.hpp>

namespace gearshift::engine {

struct UiButton {
  int button = 0;  // left, right, middle, ...
  bool down = false;
  glm::dvec2 at{0.0};  // [px] position of the mouse
};

struct UiScroll {
  glm::dvec2 lines{0.0};  // [lines] up is positive
  glm::dvec2 at{0.0};     // [px] position of the mouse
};

struct UiKey {
  int key = 0;  // GLFW's key code
  bool down = false;
};

using UiEvent = std::variant<UiButton, UiScroll, UiKey, char32_t>;  // char32_t: a letter that was typed

// Input since the last frame.
struct UiEvents {
  std::vector<UiEvent> steps;        // in the order in which they happened
  glm::dvec2 mouse{0.0};             // [px] position after all steps
  bool has_mouse = true;             // false: the mouse is outside the window, or captured for another use
  bool draws_cursor = false;         // draw a cursor, because the system shows none
  std::array<bool, 5> mouse_down{};  // buttons that are down after all steps: left, right, middle, ...
  bool focused = true;               // false: the window has no focus, so all keys are up
};

}  // namespace gearshift::engine
