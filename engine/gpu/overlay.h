// Interface for drawing on top of a finished picture.
#pragma once

#include "engine/gpu/vulkan.h"

namespace gearshift::engine {

inline constexpr VkFormat kColourFormat = VK_FORMAT_R8G8B8A8_SRGB;    // format of a finished picture
inline constexpr VkFormat kOverlayFormat = VK_FORMAT_R8G8B8A8_UNORM;  // format of the view that an overlay draws on

class Overlay {
 public:
  virtual ~Overlay() = default;
  // Called inside a rendering scope on a UNORM view of the picture (values are display-referred), with 1 sample and no
  // depth. `slot`: index of this frame, below kFramesInFlight.
  virtual void draw(VkCommandBuffer commands, VkExtent2D extent, int slot) = 0;
};

}  // namespace gearshift::engine
