// Render targets and the views of their layers.
#pragma once

#include <array>
#include <optional>

#include "engine/gpu/gpu_image.h"
#include "engine/gpu/overlay.h"
#include "engine/render/pipelines.h"

namespace gearshift::engine {

// An image with one layer per eye; a pass draws into all layers or into one.
struct EyeImage {
  EyeImage() = default;
  EyeImage(Gpu& gpu, const ImageDesc& desc);
  GpuImage image;
  ImageView all;
  std::array<ImageView, 2> one;
};

struct PictureTarget {
  PictureTarget() = default;
  PictureTarget(Gpu& gpu, VkExtent2D extent, std::uint32_t eyes, VkSampleCountFlagBits samples, bool stores_depth);
  EyeImage colour;   // the final picture, single-sampled
  EyeImage samples;  // multisampled target, if used
  EyeImage depth;
  EyeImage resolved_depth;           // first sample of a multisampled depth, if depth is stored
  std::array<ImageView, 2> overlay;  // views of the layers of colour, in kOverlayFormat
  bool multisampled = false, stores_depth = false;
  EyeImage& draw_target() noexcept { return multisampled ? samples : colour; }
  EyeImage& stored_depth() noexcept { return multisampled ? resolved_depth : depth; }
};

struct MirrorTarget {
  MirrorTarget() = default;
  MirrorTarget(Gpu& gpu, VkExtent2D extent, std::uint32_t eyes);
  EyeImage colour, depth;
};

struct ShadowTarget {
  ShadowTarget() = default;
  ShadowTarget(Gpu& gpu, std::uint32_t side);
  GpuImage depth;  // the shadow map that shaders sample
  ImageView view;
  GpuImage static_depth;  // static casters only; copied into depth before the moving casters are drawn
  ImageView static_view;
};

// Attachment for begin_rendering(), which calls vkCmdBeginRendering for one or more layers, and sets viewport and
// scissor to the whole extent. The images must already have the matching ImageUse.
struct Attachment {
  VkImageView view = VK_NULL_HANDLE;
  VkAttachmentLoadOp load = VK_ATTACHMENT_LOAD_OP_CLEAR;
  VkAttachmentStoreOp store = VK_ATTACHMENT_STORE_OP_STORE;
  VkImageView resolved = VK_NULL_HANDLE;  // null, or destination for the first sample of depth
};
void begin_rendering(VkCommandBuffer commands, VkExtent2D extent, std::uint32_t layers, const Attachment* colour,
                     const Attachment* depth);

}  // namespace gearshift::engine
