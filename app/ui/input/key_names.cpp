#include "app/ui/input/key_names.h"

#include <algorithm>
#include <array>
#include <iterator>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "engine/window/window.h"

namespace gearshift::ui {
namespace {

struct NamedKey {
  int key;
  std::string_view name;
};

// Names of all keys except letters, digits, function keys and keypad digits, whose names are computed.
constexpr std::array kNamedKeys{NamedKey{GLFW_KEY_SPACE, "Space"},
                                NamedKey{GLFW_KEY_APOSTROPHE, "Apostrophe"},
                                NamedKey{GLFW_KEY_COMMA, "Comma"},
                                NamedKey{GLFW_KEY_MINUS, "Minus"},
                                NamedKey{GLFW_KEY_PERIOD, "Period"},
                                NamedKey{GLFW_KEY_SLASH, "Slash"},
                                NamedKey{GLFW_KEY_SEMICOLON, "Semicolon"},
                                NamedKey{GLFW_KEY_EQUAL, "Equal"},
                                NamedKey{GLFW_KEY_LEFT_BRACKET, "Left Bracket"},
                                NamedKey{GLFW_KEY_BACKSLASH, "Backslash"},
                                NamedKey{GLFW_KEY_RIGHT_BRACKET, "Right Bracket"},
                                NamedKey{GLFW_KEY_GRAVE_ACCENT, "Grave Accent"},
                                NamedKey{GLFW_KEY_WORLD_1, "World 1"},
                                NamedKey{GLFW_KEY_WORLD_2, "World 2"},
                                NamedKey{GLFW_KEY_ESCAPE, "Escape"},
                                NamedKey{GLFW_KEY_ENTER, "Enter"},
                                NamedKey{GLFW_KEY_TAB, "Tab"},
                                NamedKey{GLFW_KEY_BACKSPACE, "Backspace"},
                                NamedKey{GLFW_KEY_INSERT, "Insert"},
                                NamedKey{GLFW_KEY_DELETE, "Delete"},
                                NamedKey{GLFW_KEY_RIGHT, "Right"},
                                NamedKey{GLFW_KEY_LEFT, "Left"},
                                NamedKey{GLFW_KEY_DOWN, "Down"},
                                NamedKey{GLFW_KEY_UP, "Up"},
                                NamedKey{GLFW_KEY_PAGE_UP, "Page Up"},
                                NamedKey{GLFW_KEY_PAGE_DOWN, "Page Down"},
                                NamedKey{GLFW_KEY_HOME, "Home"},
                                NamedKey{GLFW_KEY_END, "End"},
                                NamedKey{GLFW_KEY_CAPS_LOCK, "Caps Lock"},
                                NamedKey{GLFW_KEY_SCROLL_LOCK, "Scroll Lock"},
                                NamedKey{GLFW_KEY_NUM_LOCK, "Num Lock"},
                                NamedKey{GLFW_KEY_PRINT_SCREEN, "Print Screen"},
                                NamedKey{GLFW_KEY_PAUSE, "Pause"},
                                NamedKey{GLFW_KEY_KP_DECIMAL, "Keypad Decimal"},
                                NamedKey{GLFW_KEY_KP_DIVIDE, "Keypad Divide"},
                                NamedKey{GLFW_KEY_KP_MULTIPLY, "Keypad Multiply"},
                                NamedKey{GLFW_KEY_KP_SUBTRACT, "Keypad Subtract"},
                                NamedKey{GLFW_KEY_KP_ADD, "Keypad Add"},
                                NamedKey{GLFW_KEY_KP_ENTER, "Keypad Enter"},
                                NamedKey{GLFW_KEY_KP_EQUAL, "Keypad Equal"},
                                NamedKey{GLFW_KEY_LEFT_SHIFT, "Left Shift"},
                                NamedKey{GLFW_KEY_LEFT_CONTROL, "Left Control"},
                                NamedKey{GLFW_KEY_LEFT_ALT, "Left Alt"},
                                NamedKey{GLFW_KEY_LEFT_SUPER, "Left Super"},
                                NamedKey{GLFW_KEY_RIGHT_SHIFT, "Right Shift"},
                                NamedKey{GLFW_KEY_RIGHT_CONTROL, "Right Control"},
                                NamedKey{GLFW_KEY_RIGHT_ALT, "Right Alt"},
                                NamedKey{GLFW_KEY_RIGHT_SUPER, "Right Super"},
                                NamedKey{GLFW_KEY_MENU, "Menu"}};

constexpr std::string_view kSonyVendor = "054c:";
constexpr std::string_view kDualShock3 = "054c:0268", kDualSense = "054c:0ce6", kDualSenseEdge = "054c:0df2";
constexpr int kBackButton = 6, kStartButton = 7;

template <std::size_t n>
std::optional<int> index_of(const std::string_view (&names)[n], std::string_view name) {
  const auto found = std::find(std::begin(names), std::end(names), name);
  return found == std::end(names) ? std::nullopt : std::optional(static_cast<int>(found - std::begin(names)));
}

constexpr bool is_between(int key, int first, int last) {
  return key >= first && key <= last;
}

}  // namespace

std::string key_name(int key) {
  if (is_between(key, GLFW_KEY_A, GLFW_KEY_Z) || is_between(key, GLFW_KEY_0, GLFW_KEY_9))
    return {static_cast<char>(key)};  // GLFW's codes of letters and digits are ASCII
  if (is_between(key, GLFW_KEY_F1, GLFW_KEY_F25)) return "F" + std::to_string(key - GLFW_KEY_F1 + 1);
  if (is_between(key, GLFW_KEY_KP_0, GLFW_KEY_KP_9)) return "Keypad " + std::to_string(key - GLFW_KEY_KP_0);
  for (const NamedKey& named : kNamedKeys)
    if (named.key == key) return std::string(named.name);
  return "Key " + std::to_string(key);
}

std::string key_label(int key) {
  if (std::string printed = engine::printed_key(key); !printed.empty()) return printed;
  switch (key) {
    case GLFW_KEY_APOSTROPHE:
    case GLFW_KEY_COMMA:
    case GLFW_KEY_MINUS:
    case GLFW_KEY_PERIOD:
    case GLFW_KEY_SLASH:
    case GLFW_KEY_SEMICOLON:
    case GLFW_KEY_EQUAL:
    case GLFW_KEY_LEFT_BRACKET:
    case GLFW_KEY_BACKSLASH:
    case GLFW_KEY_RIGHT_BRACKET:
    case GLFW_KEY_GRAVE_ACCENT:
      return {static_cast<char>(key)};  // GLFW's codes of these keys are ASCII
    default:
      return key_name(key);
  }
}

std::optional<int> pad_button_of(std::string_view name) {
  return index_of(kPadButtons, name);
}

std::optional<int> pad_axis_of(std::string_view name) {
  return index_of(kPadAxes, name);
}

std::string pad_button_label(int button, std::string_view id) {
  constexpr const char* kXbox[] = {"A",     "B",  "X",  "Y",        "LB",          "RB",         "Back",      "Start",
                                   "Guide", "LS", "RS", "D-pad up", "D-pad right", "D-pad down", "D-pad left"};
  constexpr const char* kSony[] = {"Cross", "Circle",   "Square",      "Triangle",   "L1",
                                   "R1",    "Share",    "Options",     "PS",         "L3",
                                   "R3",    "D-pad up", "D-pad right", "D-pad down", "D-pad left"};
  if (!id.starts_with(kSonyVendor)) return kXbox[button];
  if (button == kBackButton && (id == kDualSense || id == kDualSenseEdge)) return "Create";
  if (id == kDualShock3 && button == kBackButton) return "Select";
  if (id == kDualShock3 && button == kStartButton) return "Start";
  return kSony[button];
}

std::string pad_axis_label(int axis, std::string_view id) {
  constexpr const char* kXbox[] = {"left stick, left and right",
                                   "left stick, up and down",
                                   "right stick, left and right",
                                   "right stick, up and down",
                                   "LT",
                                   "RT"};
  const bool is_trigger = axis >= 4;
  return id.starts_with(kSonyVendor) && is_trigger ? (axis == 4 ? "L2" : "R2") : kXbox[axis];
}

std::optional<int> key_of(std::string_view name) {
  if (name.starts_with("Key ")) return std::nullopt;
  for (int key = GLFW_KEY_SPACE; key <= GLFW_KEY_LAST; ++key)
    if (key_name(key) == name) return key;
  return std::nullopt;
}

bool types_text(int key) noexcept {
  return is_between(key, GLFW_KEY_SPACE, GLFW_KEY_WORLD_2) || is_between(key, GLFW_KEY_KP_0, GLFW_KEY_KP_ADD) ||
         key == GLFW_KEY_KP_EQUAL;
}

}  // namespace gearshift::ui
