// A window's mouse and keys, shared between the panel and the driver: each frame's to one of them.
#pragma once

#include <optional>

#include "app/input/driver_input.h"
#include "app/panel/panel.h"
#include "app/train/panel_pointer.h"
#include "engine/ui/ui.h"
#include "engine/window/window.h"

namespace gearshift {

class SharedInput {
 public:
  explicit SharedInput(const Bindings& bindings) : driver_({bindings}) {}

  // Once a frame, before the panel is drawn. seconds: since the last call. mouse [px]: where the window's is in the
  // picture that the panel was drawn into.
  // hand: has the panel in place of the window's mouse; nothing of it is the driver's.
  void update(const WindowInput& window, double seconds, glm::dvec2 mouse, const Panel& panel, UiContext& ui,
              const std::optional<PanelPointer>& hand = std::nullopt);

  DriverInput& driver() noexcept { return driver_; }
  glm::dvec2 turned() const noexcept {
    return turned_;
  }  // [px] the view, in this frame: the right button beside the panel

 private:
  UiEvents for_panel(const WindowInput& window, glm::dvec2 mouse, const std::optional<PanelPointer>& hand);
  void look(const WindowInput& window, bool panel_has_mouse);

  DriverInput driver_;
  bool shift_ = false, control_ = false, alt_ = false;  // held now
  bool looks_ = false;                                  // the right button went down beside the panel and is held
  bool right_was_down_ = false;
  glm::dvec2 turned_{0.0};
};

}  // namespace gearshift
