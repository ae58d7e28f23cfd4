// A window on the desktop, its input, and the swapchain that shows a picture in it. The only place that sees GLFW.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "engine/gpu/gpu.h"
#include "engine/gpu/gpu_image.h"
#include "engine/window/sticks.h"

namespace gearshift {

// Is there a display to open a window on: does the server that DISPLAY names answer? Never throws, opens nothing that
// stays.
bool has_display();

// A key that went down or up; that it repeats while held is no event.
struct KeyEvent {
  int key = 0;  // GLFW_KEY_...
  bool down = false;
  bool shift = false, control = false, alt = false;
};

// What happened since the last poll.
struct WindowInput {
  glm::dvec2 mouse{0.0};             // [px] of the framebuffer; stands still while captured
  glm::dvec2 mouse_moved{0.0};       // [px] since the last poll; also while captured
  std::array<bool, 5> mouse_down{};  // now, or for a moment since the last poll: left, right, middle, ...
  glm::dvec2 scroll{0.0};
  std::vector<KeyEvent> keys;
  std::u32string text;
  std::vector<PadState> pads;  // plugged in now
  bool focused = true;
};

class Window {
 public:
  // Throws std::runtime_error with one sentence where there is no display.
  Window(int width, int height, const std::string& title);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  static std::vector<const char*> instance_extensions();  // for GpuConfig, after the first window

  const WindowInput& poll();  // never waits; while minimised at most 20 times a second
  bool wants_close() const;
  glm::ivec2 framebuffer() const;  // [px] (0, 0) while minimised
  float content_scale() const;     // 1 at 96 dpi
  void set_full_screen(bool on);   // on the monitor that it is on
  bool full_screen() const;
  void capture_mouse(bool on);  // hidden and endless

  VkSurfaceKHR make_surface(VkInstance instance) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gearshift
