// The panel drawn into a picture of its own: for a quad in a headset, or over what a window shows.
#pragma once

#include "engine/gpu/gpu_image.h"
#include "engine/ui/ui.h"

namespace gearshift {

class UiCanvas {
 public:
  UiCanvas(Gpu& gpu, UiContext& ui) : gpu_(gpu), overlay_(gpu, ui) {}

  void fit(VkExtent2D extent);  // made anew where it has another size; waits until the device is idle then

  // Black and fully transparent, in copy_to: to be drawn on.
  GpuImage& begin(VkCommandBuffer commands);
  // The panel on top of what is there, colours times their alpha; in copy_from afterwards. slot: see Overlay.
  GpuImage& draw(VkCommandBuffer commands, int slot);

 private:
  Gpu& gpu_;
  UiOverlay overlay_;
  GpuImage image_;
  ImageView view_;
};

}  // namespace gearshift
