// Mirrors the learner's view with the panel over it in a window for the instructor: one image as large as the headset's
// panel image, fitted into the middle of the window. It never delays the headset: if the window has no free image, the
// last one stays.
#pragma once

#include <memory>

#include "app/cabin/view/visible_region.h"
#include "engine/gpu/gpu_image.h"
#include "engine/ui/ui.h"
#include "engine/window/window.h"

namespace gearshift::cabin {

// Converts a mouse position in the window to one in a panel of that size; beside the image, the result is outside. [px]
glm::dvec2 in_mirrored_panel(glm::dvec2 mouse, glm::ivec2 panel, glm::ivec2 window);

class DesktopMirror {
 public:
  // All arguments must outlive the mirror. size [px]: of the panel. Throws GpuError.
  DesktopMirror(engine::Gpu& gpu, engine::Window& window, engine::UiContext& ui, glm::ivec2 size);
  ~DesktopMirror();

  bool is_due() const;  // 30 times a second: more is not visible and costs GPU time of the headset
  // Shows the first layer of `picture` (in state copy_from), fitted into that region of the panel, with the panel over
  // it.
  void show(engine::GpuImage& picture, const VisibleRegion& part);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gearshift::cabin
