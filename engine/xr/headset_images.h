// Images that a runtime shows: taken, copied into, given back.
#pragma once

#include <span>

#include "engine/gpu/gpu_image.h"
#include "engine/xr/openxr.h"

namespace gearshift {

class HeadsetImages {
 public:
  // The first of wanted that the runtime offers; throws HeadsetError where it offers none. layers: 1, or one an eye.
  HeadsetImages(XrSession session, const Gpu& gpu, glm::ivec2 size, std::uint32_t layers,
                std::span<const VkFormat> wanted);
  ~HeadsetImages();
  HeadsetImages(const HeadsetImages&) = delete;
  HeadsetImages& operator=(const HeadsetImages&) = delete;

  // The next image, in copy_to after a transition; null where the runtime has none free for now: nothing is drawn then.
  // Until give() it is ours.
  GpuImage* take(XrDuration patience);  // [ns]
  void give();  // after the submission that writes it, which leaves it as it was got: see ready_to_give()
  void ready_to_give(VkCommandBuffer commands);

  bool ever_given() const noexcept { return ever_given_; }
  XrSwapchain get() const noexcept { return swapchain_; }
  glm::ivec2 size() const noexcept { return size_; }
  XrSwapchainSubImage layer(std::uint32_t index) const noexcept;

 private:
  XrSwapchain swapchain_ = XR_NULL_HANDLE;
  glm::ivec2 size_;
  std::vector<GpuImage> images_;
  std::uint32_t index_ = 0;
  enum class Hold { none, acquired, ours } hold_ = Hold::none;
  bool ever_given_ = false;
};

}  // namespace gearshift
