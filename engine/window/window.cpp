#include "engine/window/window.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <stdexcept>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "engine/window/glfw_use.h"

namespace gearshift::engine {

struct DesktopArea {
  int x = 0, y = 0, width = 0, height = 0;
};

namespace {

DesktopArea area_of(GLFWwindow* window) {
  DesktopArea r;
  glfwGetWindowPos(window, &r.x, &r.y);
  glfwGetWindowSize(window, &r.width, &r.height);
  return r;
}

DesktopArea area_of(GLFWmonitor* monitor) {
  DesktopArea r;
  const GLFWvidmode* mode = glfwGetVideoMode(monitor);
  glfwGetMonitorPos(monitor, &r.x, &r.y);
  r.width = mode->width;
  r.height = mode->height;
  return r;
}

long overlap(const DesktopArea& a, const DesktopArea& b) {
  const int width = std::min(a.x + a.width, b.x + b.width) - std::max(a.x, b.x);
  const int height = std::min(a.y + a.height, b.y + b.height) - std::max(a.y, b.y);
  return width <= 0 || height <= 0 ? 0 : static_cast<long>(width) * height;
}

// The monitor that shows the largest part of the window; null if there is none.
GLFWmonitor* monitor_of(GLFWwindow* window) {
  int count = 0;
  GLFWmonitor** monitors = glfwGetMonitors(&count);
  if (count == 0) return nullptr;
  const DesktopArea area = area_of(window);
  return *std::max_element(monitors, monitors + count, [&](GLFWmonitor* a, GLFWmonitor* b) {
    return overlap(area, area_of(a)) < overlap(area, area_of(b));
  });
}

}  // namespace

bool has_display() {
  try {
    const GlfwUse use;
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

struct Window::State {
  State(int width, int height, const std::string& title);
  ~State() { glfwDestroyWindow(window); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  void set_callbacks();
  void on_mouse_moved(double x, double y);
  void on_mouse_button(int button, bool down);
  bool is_visible() const;
  void measure();

  GlfwUse use;
  GLFWwindow* window = nullptr;
  WindowInput input;
  WindowInput next;  // collected for the next poll()
  std::atomic<glm::ivec2> framebuffer{glm::ivec2(0)};
  Controllers controllers;
  std::array<bool, 5> held{};  // current mouse buttons
  glm::dvec2 cursor{0.0};      // position in GLFW's window coordinates; unbounded while captured
  bool captured = false;
  bool shown = true;
  DesktopArea before_full_screen;
};

Window::State::State(int width, int height, const std::string& title) {
  glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
  window = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
  if (window == nullptr) throw std::runtime_error(fmt::format("Cannot open a window: {}.", glfw_error()));
  glfwSetWindowUserPointer(window, this);
  glfwGetCursorPos(window, &cursor.x, &cursor.y);
  measure();
  set_callbacks();
}

void Window::State::set_callbacks() {
  static constexpr auto state_of = [](GLFWwindow* w) { return static_cast<State*>(glfwGetWindowUserPointer(w)); };
  glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) { state_of(w)->on_mouse_moved(x, y); });
  glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int) {
    state_of(w)->on_mouse_button(button, action == GLFW_PRESS);
  });
  glfwSetScrollCallback(window, [](GLFWwindow* w, double x, double y) {
    WindowInput& scrolled = state_of(w)->next;
    scrolled.events.emplace_back(ScrollEvent{.lines = {x, y}, .at = scrolled.mouse});
  });
  glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int, int action, int mods) {
    if (action == GLFW_REPEAT) return;
    state_of(w)->next.events.emplace_back(KeyEvent{.key = key,
                                                   .down = action == GLFW_PRESS,
                                                   .shift = (mods & GLFW_MOD_SHIFT) != 0,
                                                   .control = (mods & GLFW_MOD_CONTROL) != 0,
                                                   .alt = (mods & GLFW_MOD_ALT) != 0});
  });
  glfwSetCharCallback(
      window, [](GLFWwindow* w, unsigned int c) { state_of(w)->next.events.emplace_back(static_cast<char32_t>(c)); });
}

void Window::State::on_mouse_moved(double x, double y) {
  int width = 0, height = 0, pixels_wide = 0, pixels_high = 0;
  glfwGetWindowSize(window, &width, &height);
  glfwGetFramebufferSize(window, &pixels_wide, &pixels_high);
  if (width <= 0 || height <= 0) return;
  const glm::dvec2 pixels{static_cast<double>(pixels_wide) / width, static_cast<double>(pixels_high) / height};
  const glm::dvec2 current{x, y};
  next.mouse_moved += (current - cursor) * pixels;
  cursor = current;
  if (!captured) next.mouse = current * pixels;
}

void Window::State::on_mouse_button(int button, bool down) {
  if (button < 0 || button >= static_cast<int>(held.size())) return;
  const auto index = static_cast<std::size_t>(button);
  held[index] = down;
  if (down) next.mouse_down[index] = true;
  next.events.emplace_back(ButtonEvent{.button = button, .down = down, .at = next.mouse});
}

// A window manager can iconify the window, or unmap it when the user changes the desktop. In both cases nothing needs
// to be drawn.
bool Window::State::is_visible() const {
  return glfwGetWindowAttrib(window, GLFW_ICONIFIED) == GLFW_FALSE &&
         glfwGetWindowAttrib(window, GLFW_VISIBLE) == GLFW_TRUE;
}

Window::Window(int width, int height, const std::string& title)
    : state_(std::make_unique<State>(width, height, title)) {}

Window::~Window() = default;

std::vector<const char*> Window::instance_extensions() {
  std::uint32_t count = 0;
  const char** names = glfwGetRequiredInstanceExtensions(&count);
  if (names == nullptr) throw GpuError("No installed Vulkan driver can draw to a window.");
  return {names, names + count};
}

const WindowInput& Window::poll() {
  State& s = *state_;
  if (!s.shown) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  (void)glance();
  std::swap(s.input, s.next);
  s.next.mouse = s.input.mouse;
  s.next.mouse_moved = glm::dvec2(0.0);
  s.next.events.clear();
  s.next.mouse_down = s.held;
  s.input.controllers = s.controllers.poll();
  s.shown = s.is_visible();
  s.measure();
  return s.input;
}

std::span<const InputEvent> Window::glance() {
  State& s = *state_;
  const std::size_t before = s.next.events.size();
  glfwPollEvents();
  s.next.focused = glfwGetWindowAttrib(s.window, GLFW_FOCUSED) == GLFW_TRUE;  // GLFW asks the window system
  return std::span(s.next.events).subspan(before);
}

void Window::State::measure() {
  glm::ivec2 size{0};
  if (shown) glfwGetFramebufferSize(window, &size.x, &size.y);
  framebuffer = size;
}

const WindowInput& Window::input() const {
  return state_->input;
}

bool Window::wants_close() const {
  return glfwWindowShouldClose(state_->window) == GLFW_TRUE;
}

glm::ivec2 Window::framebuffer() const {
  return state_->framebuffer;
}

float Window::content_scale() const {
  float x = 1.0f, y = 1.0f;
  glfwGetWindowContentScale(state_->window, &x, &y);
  return x;
}

void Window::set_full_screen(bool on) {
  if (on == full_screen()) return;
  State& s = *state_;
  if (!on) {
    const DesktopArea& r = s.before_full_screen;
    glfwSetWindowMonitor(s.window, nullptr, r.x, r.y, r.width, r.height, GLFW_DONT_CARE);
    return;
  }
  GLFWmonitor* monitor = monitor_of(s.window);
  if (monitor == nullptr) return;
  s.before_full_screen = area_of(s.window);
  const GLFWvidmode* mode = glfwGetVideoMode(monitor);
  glfwSetWindowMonitor(s.window, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

bool Window::full_screen() const {
  return glfwGetWindowMonitor(state_->window) != nullptr;
}

void Window::capture_mouse(bool on) {
  State& s = *state_;
  if (glfwRawMouseMotionSupported() == GLFW_TRUE) glfwSetInputMode(s.window, GLFW_RAW_MOUSE_MOTION, on);
  glfwSetInputMode(s.window, GLFW_CURSOR, on ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
  s.captured = on;
  glfwGetCursorPos(s.window, &s.cursor.x, &s.cursor.y);  // capturing moves the cursor; do not count that as a movement
}

VkSurfaceKHR Window::make_surface(VkInstance instance) const {
  VkSurfaceKHR surface = VK_NULL_HANDLE;
  check(glfwCreateWindowSurface(instance, state_->window, nullptr, &surface), "glfwCreateWindowSurface");
  return surface;
}

}  // namespace gearshift::engine
