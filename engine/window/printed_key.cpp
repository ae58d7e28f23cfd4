// The text on a key: GLFW knows the layout, and Xlib the capital letters.
#include <GLFW/glfw3.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>

#include <cstdint>
#include <string_view>

#include "engine/window/glfw_use.h"
#include "engine/window/window.h"

namespace gearshift::engine {
namespace {

constexpr KeySym kUnicode = 0x01000000;  // added to a code point, it makes the X server's symbol of a character
constexpr std::uint32_t kMicro = 0xb5;   // its capital is a Greek letter, which is not printed on the key

// Decodes the first character of valid UTF-8, if it has one or two bytes, as all up to U+07FF have. 0 otherwise.
std::uint32_t code_point(std::string_view text) {
  const auto byte = [text](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])); };
  if (text.size() == 1) return byte(0);
  return text.size() == 2 ? (byte(0) & 0x1f) << 6 | (byte(1) & 0x3f) : 0;
}

std::string utf8(std::uint32_t letter) {
  if (letter < 0x80) return {static_cast<char>(letter)};
  return {static_cast<char>(0xc0 | letter >> 6), static_cast<char>(0x80 | (letter & 0x3f))};
}

// The letters of the panel's font (engine/ui/ui_style.cpp, kKeyLetters).
bool has_glyph(std::uint32_t letter) {
  const auto is_between = [letter](std::uint32_t first, std::uint32_t last) {
    return letter >= first && letter <= last;
  };
  return is_between(0x21, 0x7e) || is_between(0xa1, 0x17f) || is_between(0x384, 0x45f);
}

}  // namespace

std::string printed_key(int key) {
  const bool is_keypad = key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_EQUAL;
  const char* name = !glfw_is_in_use() || is_keypad ? nullptr : glfwGetKeyName(key, 0);
  const std::uint32_t letter = name == nullptr ? 0 : code_point(name);
  if (!has_glyph(letter)) return {};
  KeySym small = 0, capital = kUnicode | letter;
  if (letter != kMicro) XConvertCase(kUnicode | letter, &small, &capital);
  const auto upper = static_cast<std::uint32_t>(capital & ~kUnicode);
  return utf8(has_glyph(upper) ? upper : letter);
}

}  // namespace gearshift::engine
