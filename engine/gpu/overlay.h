// What is drawn on top of a finished picture.
#pragma once

#include "engine/gpu/vulkan.h"

namespace gearshift {

inline constexpr VkFormat kColourFormat = VK_FORMAT_R8G8B8A8_SRGB;    // of a picture
inline constexpr VkFormat kOverlayFormat = VK_FORMAT_R8G8B8A8_UNORM;  // as an overlay sees it

class Overlay {
 public:
  virtual ~Overlay() = default;
  // Inside a rendering scope on a UNORM view of the picture (values are display-referred), 1 sample, no depth.
  // slot: which of the kFramesInFlight this frame is.
  virtual void draw(VkCommandBuffer commands, VkExtent2D extent, int slot) = 0;
};

}  // namespace gearshift
