// What the learner sees, in a window for the instructor, with the panel over it: one picture, as large as the panel's in
// the headset, whole in the middle of the window. It takes no time from the headset: where the window has no image free,
// this one stays as it is.
#pragma once

#include <memory>

#include "app/view/seen_part.h"
#include "engine/gpu/gpu_image.h"
#include "engine/ui/ui.h"
#include "engine/window/window.h"

namespace gearshift {

// Where in a panel of that size the mouse is that stands there in the window; beside the picture: outside of it. [px]
glm::dvec2 in_mirrored_panel(glm::dvec2 mouse, glm::ivec2 panel, glm::ivec2 window);

class DesktopMirror {
 public:
  // All outlive it. size [px]: of the panel. Throws GpuError.
  DesktopMirror(Gpu& gpu, Window& window, UiContext& ui, glm::ivec2 size);
  ~DesktopMirror();

  bool is_due() const;  // 30 times a second: more is not seen, and costs the headset's GPU
  // The first layer of a picture in copy_from, whole, in the middle of what that part is of the panel; the panel over it.
  void show(GpuImage& picture, const SeenPart& part);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gearshift
