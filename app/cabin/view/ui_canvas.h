// Draws the panel into an image of its own, for a quad layer in a headset or over a window's content.
#pragma once

#include "engine/gpu/gpu_image.h"
#include "engine/ui/ui.h"

namespace gearshift::cabin {

class UiCanvas {
 public:
  UiCanvas(engine::Gpu& gpu, engine::UiContext& ui) : gpu_(gpu), overlay_(gpu, ui) {}

  void fit(VkExtent2D extent);  // if the size changes, waits until the GPU is idle and recreates the image

  // Clears the image to transparent black and leaves it in state `copy_to`.
  engine::GpuImage& begin(VkCommandBuffer commands);
  // Draws the panel over the image's content, with premultiplied alpha. Leaves the image in state `copy_from`. `slot`:
  // see Overlay.
  engine::GpuImage& draw(VkCommandBuffer commands, int slot);

 private:
  engine::Gpu& gpu_;
  engine::UiOverlay overlay_;
  engine::GpuImage image_;
  engine::ImageView view_;
};

}  // namespace gearshift::cabin
