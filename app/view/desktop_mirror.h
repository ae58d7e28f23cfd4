// What the learner sees, in a window for the instructor, with the panel over it. It takes no time from the headset: where
// the window has no image free, this one stays as it is.
#pragma once

#include <memory>

#include "app/view/seen_part.h"
#include "engine/gpu/gpu_image.h"
#include "engine/ui/ui.h"
#include "engine/window/window.h"

namespace gearshift {

class DesktopMirror {
 public:
  // All outlive it. Throws GpuError.
  DesktopMirror(Gpu& gpu, Window& window, UiContext& ui);
  ~DesktopMirror();

  bool is_due() const;  // 30 times a second: more is not seen, and costs the headset's GPU
  // The first layer of a picture in copy_from, whole, in the middle of that part of the window; the panel over all of it.
  void show(GpuImage& picture, const SeenPart& part);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gearshift
