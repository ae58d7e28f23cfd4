// Mouse, keys and text as plain values, independent of the window library.
#pragma once

#include <array>
#include <deque>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

namespace gearshift::engine {

struct UiKey {
  int key = 0;  // GLFW's key code
  bool down = false;
};

// Input since the last frame.
struct UiEvents {
  glm::dvec2 mouse{0.0};             // [px]
  bool has_mouse = true;             // false: the mouse is outside the window, or captured for another use
  bool draws_cursor = false;         // draw a cursor, because the system shows none
  std::array<bool, 5> mouse_down{};  // buttons that are down now: left, right, middle, ...
  glm::dvec2 scroll{0.0};            // [lines] up is positive
  std::vector<UiKey> keys;           // in the order of the events
  bool shift = false, control = false, alt = false;
  std::u32string text;
  bool focused = true;  // false: the window has no focus, so all keys are up
};

// Queues keys and letters for the current context's ImGuiIO. Dear ImGui 1.86 sees only the state of each key at each
// frame. So presses and releases between two frames are spread over several frames, in order.
class UiKeyQueue {
 public:
  void push(const UiEvents& events);
  void feed_next_frame();  // writes as many events as one frame can represent, for the next NewFrame

 private:
  struct Item {
    UiKey key;
    char32_t letter = 0;  // if not 0, a letter instead of a key
    bool shift = false, control = false, alt = false;
  };
  bool starts_frame(const Item& item) const;

  std::deque<Item> items_;
  std::vector<int> changed_;                            // keys polled by Dear ImGui that changed in this frame
  bool shift_ = false, control_ = false, alt_ = false;  // state after the last push
};

// Writes mouse and wheel to the current context's ImGuiIO, where the next NewFrame reads them.
void feed_mouse(const UiEvents& events);

// Tells Dear ImGui which GLFW key codes correspond to its own keys. Call once per context.
void map_imgui_keys();

}  // namespace gearshift::engine
