#include "app/session/shared_input.h"

#include <algorithm>
#include <variant>

namespace gearshift::session {
namespace {

// [px] Where a button was first pressed since the last poll; otherwise, where the mouse is.
glm::dvec2 deciding_position(const engine::WindowInput& window) {
  for (const engine::InputEvent& event : window.events) {
    const auto* const button = std::get_if<engine::ButtonEvent>(&event);
    if (button != nullptr && button->down) return button->at;
  }
  return window.mouse;
}

}  // namespace

void SharedInput::update(const engine::WindowInput& window, double seconds, const InPanel& in_panel,
                         const ui::Panel& panel, engine::UiContext& ui, const std::optional<PanelPointer>& hand) {
  const bool panel_has_mouse = panel.covers(in_panel(deciding_position(window))), panel_has_keys = panel.has_keyboard();
  ui.feed(for_panel(window, in_panel, hand));
  driver_.update(window, seconds, panel_has_mouse, panel_has_keys);
  look(window, panel_has_mouse);
}

// The window's input as passed to the panel.
engine::UiEvents SharedInput::for_panel(const engine::WindowInput& window, const InPanel& in_panel,
                                        const std::optional<PanelPointer>& hand) const {
  engine::UiEvents events;
  events.focused = window.focused;
  events.mouse = in_panel(window.mouse);
  events.has_mouse = !driver_.mouse_moves_lever();
  events.mouse_down = window.mouse_down;
  const bool mouse_steps = events.has_mouse && !hand;
  for (const engine::InputEvent& event : window.events) {
    if (const auto* key = std::get_if<engine::KeyEvent>(&event)) {
      events.steps.emplace_back(engine::UiKey{key->key, key->down});
    } else if (const auto* letter = std::get_if<char32_t>(&event)) {
      events.steps.emplace_back(*letter);
    } else if (const auto* button = std::get_if<engine::ButtonEvent>(&event)) {
      if (mouse_steps) events.steps.emplace_back(engine::UiButton{button->button, button->down, in_panel(button->at)});
      events.mouse_down[static_cast<std::size_t>(button->button)] = button->down;
    } else if (const auto* scroll = std::get_if<engine::ScrollEvent>(&event); mouse_steps && scroll != nullptr) {
      events.steps.emplace_back(engine::UiScroll{scroll->lines, in_panel(scroll->at)});
    }
  }
  if (hand) {
    events.mouse = hand->at;
    events.has_mouse = events.draws_cursor = true;
    events.mouse_down = {hand->down};
    events.steps.emplace_back(engine::UiScroll{hand->scroll, hand->at});
  }
  return events;
}

void SharedInput::look(const engine::WindowInput& window, bool panel_has_mouse) {
  const bool right = window.mouse_down[1];
  is_turning_ = right && (right_was_down_ ? is_turning_ : !panel_has_mouse);
  right_was_down_ = right;
  turned_ = is_turning_ ? window.mouse_moved : glm::dvec2(0.0);
}

}  // namespace gearshift::session
