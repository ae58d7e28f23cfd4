// Presents a picture in a window: acquire, blit, present. Survives resizing, minimising and a lost surface.
#pragma once

#include <memory>
#include <span>

#include "engine/window/window.h"

namespace gearshift::engine {

// Placement of a picture in the window: one of its layers, scaled into a fraction of the window's width.
struct ShownLayer {
  std::uint32_t layer = 0;
  float from = 0.0f, to = 1.0f;  // [1] fractions of the window's width
};

// Rectangle [px] of a layer in the window. It is as large as the layer's part of the window allows, and centred there.
VkRect2D placement_of(const ShownLayer& layer, VkExtent2D picture, VkExtent2D window);

class Swapchain {
 public:
  // Without vsync, acquire() does not wait. Use this for a window that mirrors the headset's picture, because waiting
  // would delay the headset.
  Swapchain(Gpu& gpu, Window& window, bool vsync = true);
  ~Swapchain();

  // Acquires the next image. Returns false if the window can show no image now (minimised, being resized): draw
  // nothing, poll the window and try again. If true, the frame must wait for the semaphore acquired() and signal
  // rendered().
  bool acquire();
  VkSemaphore acquired() const noexcept;
  VkSemaphore rendered() const noexcept;

  // Records a blit of the picture (kColourFormat, in copy_from) into the acquired image; the rest of the window is
  // black.
  void record(VkCommandBuffer commands, GpuImage& picture, std::span<const ShownLayer> layers);

  void present();  // call after the submission. Throws GpuLost
  VkExtent2D extent() const noexcept;
  std::uint64_t rebuild_count() const noexcept;  // number of rebuilds after the first build

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gearshift::engine
