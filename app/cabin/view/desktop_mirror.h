// Mirrors the learner's view, with the panel over it, in a window for the instructor: an image as large as the panel's
// image in the headset, fitted into the middle of the window. The mirror never delays the headset: if the window has no
// free image, the previous image stays visible.
#pragma once

#include <memory>

#include "app/cabin/view/visible_region.h"
#include "engine/gpu/gpu_image.h"
#include "engine/ui/ui.h"
#include "engine/window/window.h"

namespace gearshift::cabin {

// [px] Converts a mouse position in the window to a position in a panel of this size. If the mouse is not over the
// image, the result is outside the panel.
glm::dvec2 in_mirrored_panel(glm::dvec2 mouse, glm::ivec2 panel, glm::ivec2 window);

class DesktopMirror {
 public:
  // All arguments must outlive the mirror. `size` [px]: size of the panel's image. Throws GpuError.
  DesktopMirror(engine::Gpu& gpu, engine::Window& window, engine::UiContext& ui, glm::ivec2 size);
  ~DesktopMirror();

  bool is_due() const;  // true 30 times per second: a higher rate would take GPU time from the headset
  // Shows the first layer of `picture`, fitted into `part` of the panel's image, with the panel over it. The layer must
  // be in state `copy_from`.
  void show(engine::GpuImage& picture, const VisibleRegion& part);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gearshift::cabin
