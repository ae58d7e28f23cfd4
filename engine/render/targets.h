// Images that are drawn into, and the views of their layers.
#pragma once

#include <array>
#include <optional>

#include "engine/gpu/gpu_image.h"
#include "engine/gpu/overlay.h"
#include "engine/render/pipelines.h"

namespace gearshift {

// One layer an eye; a pass draws into all of them or into one.
struct EyeImage {
  EyeImage() = default;
  EyeImage(Gpu& gpu, const ImageDesc& desc);
  GpuImage image;
  ImageView all;
  std::array<ImageView, 2> one;
};

struct PictureTarget {
  PictureTarget() = default;
  PictureTarget(Gpu& gpu, VkExtent2D extent, std::uint32_t eyes, VkSampleCountFlagBits samples, bool keeps_depth);
  EyeImage colour;   // what is shown: one sample
  EyeImage samples;  // drawn into where there are several
  EyeImage depth;
  EyeImage one_depth;                // of several samples the first, where depth is kept
  std::array<ImageView, 2> overlay;  // the layers of colour as kOverlayFormat
  bool multisampled = false, keeps_depth = false;
  EyeImage& drawn() noexcept { return multisampled ? samples : colour; }
  EyeImage& kept_depth() noexcept { return multisampled ? one_depth : depth; }
};

struct MirrorTarget {
  MirrorTarget() = default;
  MirrorTarget(Gpu& gpu, VkExtent2D extent, std::uint32_t eyes);
  EyeImage colour, depth;
};

struct ShadowTarget {
  ShadowTarget() = default;
  ShadowTarget(Gpu& gpu, std::uint32_t side);
  GpuImage depth;  // what is looked up
  ImageView view;
  GpuImage still;  // of what never moves; copied into depth before the rest is drawn
  ImageView still_view;
};

// vkCmdBeginRendering over some layers; the attachments must stand ready. Viewport and scissor cover them.
struct Attachment {
  VkImageView view = VK_NULL_HANDLE;
  VkAttachmentLoadOp load = VK_ATTACHMENT_LOAD_OP_CLEAR;
  VkAttachmentStoreOp store = VK_ATTACHMENT_STORE_OP_STORE;
  VkImageView resolved = VK_NULL_HANDLE;  // gets the first sample of depth
};
void begin_rendering(VkCommandBuffer commands, VkExtent2D extent, std::uint32_t layers, const Attachment* colour,
                     const Attachment* depth);

}  // namespace gearshift
