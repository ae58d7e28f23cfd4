#include "app/session/shared_input.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace gearshift::session {

void SharedInput::update(const engine::WindowInput& window, double seconds, glm::dvec2 mouse, const ui::Panel& panel,
                         engine::UiContext& ui, const std::optional<PanelPointer>& hand) {
  const bool panel_has_mouse = panel.covers(mouse), panel_has_keys = panel.has_keyboard();
  ui.feed(for_panel(window, mouse, hand));
  driver_.update(window, seconds, panel_has_mouse, panel_has_keys);
  look(window, panel_has_mouse);
}

// The window's input as passed to the panel. This class tracks the state of Shift, Ctrl and Alt itself, because a key
// event of a modifier carries the state before the event.
engine::UiEvents SharedInput::for_panel(const engine::WindowInput& window, glm::dvec2 mouse,
                                        const std::optional<PanelPointer>& hand) {
  engine::UiEvents events;
  events.mouse = mouse;
  events.has_mouse = !driver_.mouse_moves_lever();
  events.mouse_down = window.mouse_down;
  events.scroll = window.scroll;
  if (hand) {
    events.mouse = hand->at;
    events.has_mouse = events.draws_cursor = true;
    events.mouse_down = {hand->down};
    events.scroll = hand->scroll;
  }
  for (const engine::KeyEvent& key : window.keys) {
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

void SharedInput::look(const engine::WindowInput& window, bool panel_has_mouse) {
  const bool right = window.mouse_down[1];
  is_turning_ = right && (right_was_down_ ? is_turning_ : !panel_has_mouse);
  right_was_down_ = right;
  turned_ = is_turning_ ? window.mouse_moved : glm::dvec2(0.0);
}

}  // namespace gearshift::session
