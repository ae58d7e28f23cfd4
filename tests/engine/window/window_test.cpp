#include "engine/window/window.h"

#include <GLFW/glfw3.h>
#include <stdlib.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <stdexcept>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include <doctest/doctest.h>

#include "tests/engine/window/x_server.h"

using namespace gearshift::engine;
using namespace gearshift::test;

namespace {

double seconds_of(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Polls until the condition holds, because changes made by another X client arrive through the server, with a delay.
// Returns false after ten seconds.
bool becomes_true(gearshift::engine::Window& window, const std::function<bool(const WindowInput&)>& condition) {
  for (int i = 0; i < 1000; ++i) {
    if (condition(window.poll())) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

template <class Event>
std::vector<Event> all_of(const WindowInput& input) {
  std::vector<Event> events;
  for (const InputEvent& event : input.events)
    if (const auto* of_this_kind = std::get_if<Event>(&event)) events.push_back(*of_this_kind);
  return events;
}

}  // namespace

TEST_CASE("the tests have a display; without DISPLAY a window is rejected with one sentence") {
  const XServer server;
  CHECK(has_display());
  const std::string display = getenv("DISPLAY");
  unsetenv("DISPLAY");
  CHECK_FALSE(has_display());
  std::string why;
  try {
    const gearshift::engine::Window window(320, 240, "nowhere");
  } catch (const std::runtime_error& error) {
    why = error.what();
  }
  setenv("DISPLAY", display.c_str(), 1);
  CHECK(why.find("no display") != std::string::npos);
  CHECK(why.back() == '.');
  CHECK(has_display());
}

TEST_CASE("checking for a display does not affect an open window") {
  const XServer server;
  gearshift::engine::Window window(320, 240, "stays");
  CHECK(has_display());
  window.poll();
  CHECK(server.find("stays") != 0);
  CHECK(window.framebuffer() == glm::ivec2(320, 240));
}

TEST_CASE("a window has the requested size and title, follows a resize, and reports a close request") {
  XServer server;
  gearshift::engine::Window window(400, 300, "first");
  window.poll();
  CHECK(window.framebuffer() == glm::ivec2(400, 300));
  CHECK(window.content_scale() > 0.0f);
  const ::Window id = server.find("first");
  REQUIRE(id != 0);
  server.resize(id, 333, 222);
  CHECK(becomes_true(window, [&](const auto&) { return window.framebuffer() == glm::ivec2(333, 222); }));
  CHECK_FALSE(window.wants_close());
  server.request_close(id);
  CHECK(becomes_true(window, [&](const auto&) { return window.wants_close(); }));
}

TEST_CASE("poll() does not wait; minimised in either way, the framebuffer is empty and polls are 20 per second") {
  XServer server;
  gearshift::engine::Window window(400, 300, "minimised");
  window.poll();
  const ::Window id = server.find("minimised");
  REQUIRE(id != 0);
  const auto ten_polls = [&] {  // [s] the shortest of three runs, because other processes may delay a run
    double best = 1e9;
    for (int attempt = 0; attempt < 3; ++attempt) {
      best = std::min(best, seconds_of([&] {
                        for (int i = 0; i < 10; ++i) window.poll();
                      }));
    }
    return best;
  };
  const auto is_minimised = [&](const auto&) { return window.framebuffer() == glm::ivec2(0); };
  const auto is_back = [&](const auto&) { return window.framebuffer() == glm::ivec2(400, 300); };
  CHECK(ten_polls() < 0.25);
  server.unmap(id);
  CHECK(becomes_true(window, is_minimised));
  CHECK(ten_polls() >= 0.5);
  server.map(id);
  CHECK(becomes_true(window, is_back));
  server.set_iconic(id, true);
  CHECK(becomes_true(window, is_minimised));
  server.set_iconic(id, false);
  CHECK(becomes_true(window, is_back));
  CHECK(ten_polls() < 0.25);
}

TEST_CASE("the mouse position is in pixels of the window, and its movements add up") {
  XServer server;
  gearshift::engine::Window window(400, 300, "mouse");
  window.poll();
  const ::Window id = server.find("mouse");
  server.move(id, 100, 50);
  xdotool("mousemove 150 150");
  REQUIRE(becomes_true(window, [](const auto& in) { return in.mouse == glm::dvec2(50, 100); }));
  glm::dvec2 moved{0.0};
  xdotool("mousemove 180 140 mousemove 300 200");
  CHECK(becomes_true(window, [&](const auto& in) {
    moved += in.mouse_moved;
    return in.mouse == glm::dvec2(200, 150);
  }));
  CHECK(moved == glm::dvec2(150, 50));
  CHECK(window.poll().mouse_moved == glm::dvec2(0.0));
}

TEST_CASE("a click shorter than a frame is reported by one poll; a held button is reported until released") {
  XServer server;
  gearshift::engine::Window window(400, 300, "click");
  window.poll();
  server.move(server.find("click"), 0, 0);
  xdotool("mousemove 100 100 click 1");
  int polls_down = 0;
  CHECK(becomes_true(window, [&](const auto& in) { return (polls_down += in.mouse_down[0]) > 0; }));
  CHECK_FALSE(window.poll().mouse_down[0]);
  xdotool("mousedown 3");
  CHECK(becomes_true(window, [](const auto& in) { return in.mouse_down[1]; }));
  CHECK(window.poll().mouse_down[1]);
  xdotool("mouseup 3");
  CHECK(becomes_true(window, [](const auto& in) { return !in.mouse_down[1]; }));
  glm::dvec2 scrolled{0.0};
  xdotool("click 4 click 4 click 5");
  CHECK(becomes_true(window, [&](const auto& in) {
    for (const ScrollEvent& event : all_of<ScrollEvent>(in)) scrolled += event.lines;
    return scrolled == glm::dvec2(0, 1);
  }));
}

TEST_CASE("keys arrive as events, in order, with their modifiers; text arrives as characters") {
  XServer server;
  gearshift::engine::Window window(400, 300, "keys");
  REQUIRE(becomes_true(window, [](const auto& in) { return in.focused; }));
  std::vector<KeyEvent> events;
  std::u32string text;
  const auto gather = [&](const WindowInput& in) {
    for (const KeyEvent& event : all_of<KeyEvent>(in)) events.push_back(event);
    for (const char32_t letter : all_of<char32_t>(in)) text += letter;
    return false;
  };
  xdotool("key a");
  xdotool("keydown shift key b keyup shift");
  becomes_true(window, [&](const auto& in) { return gather(in), events.size() >= 6; });
  REQUIRE(events.size() == 6);
  const auto is = [&](std::size_t i, int key, bool down) { return events[i].key == key && events[i].down == down; };
  CHECK(is(0, GLFW_KEY_A, true));
  CHECK(is(1, GLFW_KEY_A, false));
  CHECK(is(2, GLFW_KEY_LEFT_SHIFT, true));
  CHECK(is(3, GLFW_KEY_B, true));
  CHECK(events[3].shift);
  CHECK_FALSE(events[0].shift);
  CHECK(is(4, GLFW_KEY_B, false));
  CHECK(is(5, GLFW_KEY_LEFT_SHIFT, false));
  CHECK(text == U"aB");
  CHECK(all_of<KeyEvent>(window.poll()).empty());
}

TEST_CASE("a captured mouse moves past the edge of the screen, and is released where it was captured") {
  XServer server;
  gearshift::engine::Window window(400, 300, "captured");
  REQUIRE(becomes_true(window, [](const auto& in) { return in.focused; }));
  server.move(server.find("captured"), 0, 0);
  xdotool("mousemove 200 150");
  REQUIRE(becomes_true(window, [](const auto& in) { return in.mouse == glm::dvec2(200, 150); }));
  window.capture_mouse(true);
  glm::dvec2 moved{0.0};
  window.poll();
  for (int i = 0; i < 20; ++i) {
    xdotool("mousemove_relative 150 0");
    moved += window.poll().mouse_moved;
  }
  becomes_true(window, [&](const auto& in) {
    moved += in.mouse_moved;
    return moved.x >= 3000.0;
  });
  CHECK(moved == glm::dvec2(3000, 0));  // all of 20 x 150 px, although the screen is only 1280 px wide
  CHECK(window.poll().mouse == glm::dvec2(200, 150));
  window.capture_mouse(false);
  moved = glm::dvec2(0.0);
  xdotool("mousemove 210 150");
  CHECK(becomes_true(window, [&](const auto& in) {
    moved += in.mouse_moved;
    return in.mouse == glm::dvec2(210, 150);
  }));
  CHECK(moved == glm::dvec2(10, 0));  // only the move from 200 to 210; the release adds nothing
}

TEST_CASE("full screen covers the monitor; afterwards the window is as it was before") {
  XServer server;
  gearshift::engine::Window window(400, 300, "full");
  window.poll();
  server.move(server.find("full"), 120, 80);
  window.poll();
  CHECK_FALSE(window.full_screen());
  for (int times = 0; times < 3; ++times) {
    window.set_full_screen(true);
    window.set_full_screen(true);
    CHECK(window.full_screen());
    CHECK(becomes_true(window, [&](const auto&) { return window.framebuffer() == glm::ivec2(1280, 720); }));
    window.set_full_screen(false);
    CHECK_FALSE(window.full_screen());
    CHECK(becomes_true(window, [&](const auto&) { return window.framebuffer() == glm::ivec2(400, 300); }));
  }
}
