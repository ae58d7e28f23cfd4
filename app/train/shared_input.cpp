#include "app/train/shared_input.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace gearshift {

void SharedInput::update(const WindowInput& window, double seconds, glm::dvec2 mouse, const Panel& panel, UiContext& ui,
                         const std::optional<PanelPointer>& hand) {
  const bool panel_has_mouse = panel.covers(mouse), panel_has_keys = panel.has_keyboard();
  ui.feed(for_panel(window, mouse, hand));
  driver_.update(window, seconds, panel_has_mouse, panel_has_keys);
  look(window, panel_has_mouse);
}

// A key event tells which modifiers were held before it, and none comes while one is only held: they are kept here.
UiEvents SharedInput::for_panel(const WindowInput& window, glm::dvec2 mouse, const std::optional<PanelPointer>& hand) {
  UiEvents events;
  events.mouse = mouse;
  events.mouse_here = !driver_.mouse_leads();
  events.mouse_down = window.mouse_down;
  events.scroll = window.scroll;
  if (hand) {
    events.mouse = hand->at;
    events.mouse_here = events.draws_mouse = true;
    events.mouse_down = {hand->down};
    events.scroll = hand->scroll;
  }
  for (const KeyEvent& key : window.keys) {
    events.keys.push_back({key.key, key.down});
    if (key.key == GLFW_KEY_LEFT_SHIFT || key.key == GLFW_KEY_RIGHT_SHIFT) shift_ = key.down;
    if (key.key == GLFW_KEY_LEFT_CONTROL || key.key == GLFW_KEY_RIGHT_CONTROL) control_ = key.down;
    if (key.key == GLFW_KEY_LEFT_ALT || key.key == GLFW_KEY_RIGHT_ALT) alt_ = key.down;
  }
  if (!window.focused) shift_ = control_ = alt_ = false;
  events.shift = shift_;
  events.control = control_;
  events.alt = alt_;
  events.text = window.text;
  events.focused = window.focused;
  return events;
}

void SharedInput::look(const WindowInput& window, bool panel_has_mouse) {
  const bool right = window.mouse_down[1];
  looks_ = right && (right_was_down_ ? looks_ : !panel_has_mouse);
  right_was_down_ = right;
  turned_ = looks_ ? window.mouse_moved : glm::dvec2(0.0);
}

}  // namespace gearshift
