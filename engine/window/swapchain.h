// Presents a picture in a window: acquire, blit, present. Survives resizing, minimising and a lost surface.
#pragma once

#include <memory>
#include <span>

#include "engine/window/window.h"

namespace gearshift::engine {

// Placement of a picture in the window: one of its layers, scaled into a fraction of the window's width.
struct ShownLayer {
  std::uint32_t layer = 0;
  float from = 0.0f, to = 1.0f;  // [1] as fractions of the window's width
};

// Rectangle [px] of a layer in the window: as large as its part of the window allows, and centred in it.
VkRect2D placement_of(const ShownLayer& layer, VkExtent2D picture, VkExtent2D window);

class Swapchain {
 public:
  // Without vsync, acquire() does not wait: for a window that mirrors the picture of a headset, which must not be
  // delayed.
  Swapchain(Gpu& gpu, Window& window, bool vsync = true);
  ~Swapchain();

  // Acquires the next image. False if there is nothing to present to (minimised, being resized): draw nothing, poll and
  // try again. If true, acquired() and rendered() are the semaphores of this frame: wait for the first, signal the
  // second.
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
