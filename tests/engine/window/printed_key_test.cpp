// The text on each key, by the keyboard layout of the X server.
#include <GLFW/glfw3.h>

#include <chrono>
#include <cstdlib>
#include <map>
#include <string>
#include <thread>

#include <doctest/doctest.h>

#include "engine/window/window.h"
#include "tests/engine/window/x_server.h"

using namespace gearshift::engine;
using namespace gearshift::test;

TEST_CASE("a key has the text that the user's layout prints on it, in capitals, also after the layout has changed") {
  CHECK(printed_key(GLFW_KEY_A).empty());  // GLFW is not in use
  const XServer server;
  gearshift::engine::Window window(320, 240, "layouts");
  (void)printed_key(GLFW_KEY_A);  // with the first key, Xlib asks the server to report changes; poll() sends this
  window.poll();
  using Keys = std::map<int, std::string>;
  // Read from xkeyboard-config's symbols of these layouts.
  const std::map<std::string, Keys> layouts{
      {"us", {{GLFW_KEY_A, "A"}, {GLFW_KEY_SEMICOLON, ";"}, {GLFW_KEY_1, "1"}, {GLFW_KEY_GRAVE_ACCENT, "`"}}},
      {"fr", {{GLFW_KEY_A, "Q"}, {GLFW_KEY_SEMICOLON, "M"}, {GLFW_KEY_1, "&"}, {GLFW_KEY_LEFT_BRACKET, "^"}}},
      {"de", {{GLFW_KEY_Z, "Y"}, {GLFW_KEY_LEFT_BRACKET, "Ü"}, {GLFW_KEY_MINUS, "ß"}, {GLFW_KEY_RIGHT_BRACKET, "+"}}},
      {"us -variant dvorak", {{GLFW_KEY_S, "O"}, {GLFW_KEY_LEFT_BRACKET, "/"}}},
      {"be", {{GLFW_KEY_BACKSLASH, "µ"}}},  // its capital is a Greek letter that is not on the key
      {"pl", {{GLFW_KEY_A, "A"}}},
      {"cz", {{GLFW_KEY_2, "Ě"}, {GLFW_KEY_SEMICOLON, "Ů"}}},
      {"tr", {{GLFW_KEY_LEFT_BRACKET, "Ğ"}, {GLFW_KEY_SEMICOLON, "Ş"}}},
      {"gr", {{GLFW_KEY_A, "Α"}, {GLFW_KEY_S, "Σ"}, {GLFW_KEY_W, "Σ"}}},
      {"ru", {{GLFW_KEY_A, "Ф"}, {GLFW_KEY_SEMICOLON, "Ж"}, {GLFW_KEY_GRAVE_ACCENT, "Ё"}}},
      {"il", {{GLFW_KEY_A, ""}}},  // the panel's font has no Hebrew letters; a Latin letter is printed beside them
  };
  for (const auto& [layout, keys] : layouts) {
    CAPTURE(layout);
    REQUIRE(std::system(("setxkbmap " + layout).c_str()) == 0);
    for (const auto& [key, text] : keys) {
      CAPTURE(key);
      for (int i = 0; i < 200 && printed_key(key) != text; ++i) {  // the server's message takes a while
        window.poll();
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
      }
      CHECK(printed_key(key) == text);
    }
    for (const int key : {GLFW_KEY_LEFT_SHIFT, GLFW_KEY_SPACE, GLFW_KEY_F1, GLFW_KEY_KP_7, GLFW_KEY_UP})
      CHECK(printed_key(key).empty());
  }
  CHECK(std::system("setxkbmap us") == 0);
}
