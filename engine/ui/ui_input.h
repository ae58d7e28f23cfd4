// Mouse, keys and text as plain values, for whoever has a window.
#pragma once

#include <array>
#include <deque>
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
  bool draws_mouse = false;          // nobody else shows where it is
  std::array<bool, 5> mouse_down{};  // now: left, right, middle, ...
  glm::dvec2 scroll{0.0};            // [lines] up +
  std::vector<UiKey> keys;           // in order
  bool shift = false, control = false, alt = false;
  std::u32string text;
  bool focused = true;  // false: the window lost it, all keys are up
};

// Keys and letters on their way into the current context's ImGuiIO. Dear ImGui 1.86 sees keys as they stand in a frame
// alone: what goes down and up between two frames is dealt out over several of them, in its order.
class UiKeyQueue {
 public:
  void push(const UiEvents& events);
  void deal();  // as much as one frame can tell, for the next NewFrame

 private:
  struct Item {
    UiKey key;
    char32_t letter = 0;  // not 0: a letter and no key
    bool shift = false, control = false, alt = false;
  };
  bool starts_frame(const Item& item) const;

  std::deque<Item> items_;
  std::vector<int> changed_;                            // keys in this frame that Dear ImGui looks at
  bool shift_ = false, control_ = false, alt_ = false;  // after the last push
};

// Mouse and wheel into the current context's ImGuiIO, which reads them in the next NewFrame.
void feed_mouse(const UiEvents& events);

// Tells Dear ImGui which of GLFW's keys are its own: once per context.
void map_imgui_keys();

}  // namespace gearshift
