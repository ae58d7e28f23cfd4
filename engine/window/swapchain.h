// Shows a picture in a window: acquire, blit, present. Survives resizing, minimising and a lost surface.
#pragma once

#include <memory>
#include <span>

#include "engine/window/window.h"

namespace gearshift {

// Where a picture goes in the window: a layer of it, scaled into a part of the width.
struct ShownLayer {
  std::uint32_t layer = 0;
  float from = 0.0f, to = 1.0f;  // [1] of the window's width
};

// Where in the window a layer of a picture of that size lies: as large as its part allows, in the middle of it. [px]
VkRect2D place_of(const ShownLayer& layer, VkExtent2D picture, VkExtent2D window);

class Swapchain {
 public:
  // Without vsync acquire() never waits either: for a window beside something that must not be held up.
  Swapchain(Gpu& gpu, Window& window, bool vsync = true);
  ~Swapchain();

  // False: there is nothing to show on now (minimised, being resized): draw nothing, poll and try again. On true,
  // acquired() and rendered() are the semaphores of this frame: wait for the first, signal the second.
  bool acquire();
  VkSemaphore acquired() const noexcept;
  VkSemaphore rendered() const noexcept;

  // Records the blit of the picture (kColourFormat, in copy_from) into the acquired image; what is beside it is black.
  void record(VkCommandBuffer commands, GpuImage& picture, std::span<const ShownLayer> layers);

  void present();  // after the submission. Throws GpuLost
  VkExtent2D extent() const noexcept;
  std::uint64_t rebuilt() const noexcept;  // times, after the first

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gearshift
