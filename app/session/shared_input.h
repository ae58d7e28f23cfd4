// Distributes a window's mouse and keys: in each frame, either the panel or the driver gets the mouse, and either the
// panel or the driver gets the keys.
#pragma once

#include <functional>
#include <optional>

#include "app/session/panel_pointer.h"
#include "app/ui/input/driver_input.h"
#include "app/ui/panel/panel.h"
#include "engine/ui/ui.h"
#include "engine/window/window.h"

namespace gearshift::session {

class SharedInput {
 public:
  explicit SharedInput(const ui::Bindings& bindings) : driver_({bindings}) {}

  // Converts a position in the window [px] to a position in the picture into which the panel was drawn [px].
  using InPanel = std::function<glm::dvec2(glm::dvec2)>;

  // Call once per frame, before the panel is drawn. `seconds`: time since the previous call. `hand`: a pointer that
  // replaces the window's mouse on the panel, but not for the driver.
  void update(const engine::WindowInput& window, double seconds, const InPanel& in_panel, const ui::Panel& panel,
              engine::UiContext& ui, const std::optional<PanelPointer>& hand = std::nullopt);

  ui::DriverInput& driver() noexcept { return driver_; }
  // [px] Mouse movement in this frame that turns the view. The view turns while the right button is held, if the button
  // was pressed outside the panel.
  glm::dvec2 turned() const noexcept { return turned_; }

 private:
  engine::UiEvents for_panel(const engine::WindowInput& window, const InPanel& in_panel,
                             const std::optional<PanelPointer>& hand) const;
  void look(const engine::WindowInput& window, bool panel_has_mouse);

  ui::DriverInput driver_;
  bool is_turning_ = false;  // the right button was pressed outside the panel and is still down
  bool right_was_down_ = false;
  glm::dvec2 turned_{0.0};
};

}  // namespace gearshift::session
