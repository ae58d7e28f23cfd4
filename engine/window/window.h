// A desktop window and its input. Only this library uses GLFW.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include <glm/vec2.hpp>

#include "engine/gpu/gpu.h"
#include "engine/gpu/gpu_image.h"
#include "engine/window/controllers.h"

namespace gearshift::engine {

// True if the X server named by DISPLAY answers. Never throws, and leaves no connection open.
bool has_display();

// Text printed on the key by the user's keyboard layout, in capitals: "Q" for GLFW_KEY_A on a French keyboard. Empty if
// the layout gives the key no character (Left Shift, F1), for keys of the keypad, for characters that the panel's font lacks, and
// before GLFW is in use. Call on the thread that uses GLFW.
std::string printed_key(int key);

// A key that went down or up; auto-repeat produces no event.
struct KeyEvent {
  int key = 0;  // GLFW_KEY_...
  bool down = false;
  bool shift = false, control = false, alt = false;
};

struct ButtonEvent {
  int button = 0;  // left, right, middle, ...
  bool down = false;
  glm::dvec2 at{0.0};  // [px] as WindowInput::mouse
};

struct ScrollEvent {
  glm::dvec2 lines{0.0};  // [lines] up is positive
  glm::dvec2 at{0.0};     // [px] as WindowInput::mouse
};

using InputEvent = std::variant<ButtonEvent, ScrollEvent, KeyEvent, char32_t>;  // char32_t: a letter that was typed

// Input since the last poll.
struct WindowInput {
  glm::dvec2 mouse{0.0};                // [px] in the framebuffer; constant while captured
  glm::dvec2 mouse_moved{0.0};          // [px] since the last poll, also while captured
  std::array<bool, 5> mouse_down{};     // down now or at any time since the last poll: left, right, middle, ...
  std::vector<InputEvent> events;       // in order
  std::vector<Controller> controllers;  // currently plugged in
  bool focused = true;
};

class Window {
 public:
  // Throws std::runtime_error with one sentence if there is no display.
  Window(int width, int height, const std::string& title);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  static std::vector<const char*> instance_extensions();  // for GpuConfig; valid once a window exists

  const WindowInput& poll();  // does not wait, except while minimised: then at most 20 polls per second
  // Collects the input for the next poll() while another thread draws in the window, and returns what is new of it. Asks
  // the window system, and so does not return while that hangs.
  std::span<const InputEvent> glance();
  const WindowInput& input() const;  // as returned by the last poll
  bool wants_close() const;
  glm::ivec2 framebuffer() const;  // [px] as of the last poll(); (0, 0) while minimised. Any thread may call it
  float content_scale() const;     // 1 at 96 dpi
  void set_full_screen(bool on);   // on the window's current monitor
  bool full_screen() const;
  void capture_mouse(bool on);  // hides the cursor and removes the limits of its movement

  VkSurfaceKHR make_surface(VkInstance instance) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gearshift::engine
