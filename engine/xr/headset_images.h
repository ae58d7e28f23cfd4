// Images of an OpenXR swapchain: acquired, copied into, released.
#pragma once

#include <span>

#include "engine/gpu/gpu_image.h"
#include "engine/xr/openxr.h"

namespace gearshift::engine {

class HeadsetImages {
 public:
  // Uses the first of the wanted formats that the runtime offers; throws HeadsetError if it offers none. `layers`: 1,
  // or one per eye.
  HeadsetImages(XrSession session, const Gpu& gpu, glm::ivec2 size, std::uint32_t layers,
                std::span<const VkFormat> wanted);
  ~HeadsetImages();
  HeadsetImages(const HeadsetImages&) = delete;
  HeadsetImages& operator=(const HeadsetImages&) = delete;

  // Acquires the next image and waits for it. The caller must transition it to copy_to, and may use it until release().
  // Returns null if the runtime has no free image within the timeout; then draw nothing.
  GpuImage* acquire(XrDuration timeout);  // [ns]
  // Call after the submission that writes the image and restores its layout, see transition_for_release().
  void release();
  void transition_for_release(VkCommandBuffer commands);

  bool has_been_released() const noexcept { return has_been_released_; }
  XrSwapchain get() const noexcept { return swapchain_; }
  glm::ivec2 size() const noexcept { return size_; }
  XrSwapchainSubImage layer(std::uint32_t index) const noexcept;

 private:
  XrSwapchain swapchain_ = XR_NULL_HANDLE;
  glm::ivec2 size_;
  std::vector<GpuImage> images_;
  std::uint32_t index_ = 0;
  enum class ImageState { none, acquired, waited } image_state_ = ImageState::none;
  bool has_been_released_ = false;
};

}  // namespace gearshift::engine
