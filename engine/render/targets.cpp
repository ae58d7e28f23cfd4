#include "engine/render/targets.h"

namespace gearshift::engine {

namespace {

constexpr VkImageUsageFlags kColour = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
constexpr VkImageUsageFlags kDepth = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
constexpr VkImageUsageFlags kSource = VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
constexpr VkImageUsageFlags kSampled = VK_IMAGE_USAGE_SAMPLED_BIT;

ImageDesc target_desc(VkExtent2D extent, std::uint32_t layers, VkFormat format, VkImageUsageFlags usage) {
  return {.width = extent.width, .height = extent.height, .layers = layers, .format = format, .usage = usage};
}

VkRenderingAttachmentInfo attachment_info(const Attachment& attachment, ImageUse use) {
  const bool resolves = attachment.resolved != VK_NULL_HANDLE;
  return {.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
          .imageView = attachment.view,
          .imageLayout = layout_of(use),
          .resolveMode = resolves ? VK_RESOLVE_MODE_SAMPLE_ZERO_BIT : VK_RESOLVE_MODE_NONE,
          .resolveImageView = attachment.resolved,
          .resolveImageLayout = resolves ? layout_of(ImageUse::depth_resolved) : VK_IMAGE_LAYOUT_UNDEFINED,
          .loadOp = attachment.load,
          .storeOp = attachment.store};  // clear value 0: black, and infinite distance in reverse-Z
}

}  // namespace

EyeImage::EyeImage(Gpu& gpu, const ImageDesc& desc)
    : image(gpu, desc), all(make_view(gpu, image, VK_IMAGE_VIEW_TYPE_2D_ARRAY, 0, desc.layers)) {
  for (std::uint32_t eye = 0; eye < desc.layers; ++eye) one[eye] = make_view(gpu, image, VK_IMAGE_VIEW_TYPE_2D, eye, 1);
}

PictureTarget::PictureTarget(Gpu& gpu, VkExtent2D extent, std::uint32_t eyes, VkSampleCountFlagBits count,
                             bool keep_depth)
    : multisampled(count != VK_SAMPLE_COUNT_1_BIT), stores_depth(keep_depth) {
  ImageDesc picture_desc =
      target_desc(extent, eyes, kColourFormat, kColour | kSource | kSampled | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
  picture_desc.second_format = kOverlayFormat;
  colour = EyeImage(gpu, picture_desc);
  for (std::uint32_t eye = 0; eye < eyes; ++eye)
    overlay[eye] = make_view(gpu, colour.image, VK_IMAGE_VIEW_TYPE_2D, eye, 1, kOverlayFormat);
  ImageDesc depth_desc = target_desc(extent, eyes, kDepthFormat, kDepth | (keep_depth && !multisampled ? kSource : 0));
  depth_desc.samples = count;
  depth = EyeImage(gpu, depth_desc);
  if (!multisampled) return;
  ImageDesc samples_desc = target_desc(extent, eyes, kColourFormat, kColour | kSource);
  samples_desc.samples = count;
  samples = EyeImage(gpu, samples_desc);
  if (keep_depth) resolved_depth = EyeImage(gpu, target_desc(extent, eyes, kDepthFormat, kDepth | kSource));
}

MirrorTarget::MirrorTarget(Gpu& gpu, VkExtent2D extent, std::uint32_t eyes)
    : colour(gpu, target_desc(extent, eyes, kMirrorFormat, kColour | kSampled)),
      depth(gpu, target_desc(extent, eyes, kDepthFormat, kDepth)) {}

ShadowTarget::ShadowTarget(Gpu& gpu, std::uint32_t side)
    : depth(gpu, target_desc({side, side}, 1, kShadowFormat, kDepth | kSampled | VK_IMAGE_USAGE_TRANSFER_DST_BIT)),
      view(make_view(gpu, depth, VK_IMAGE_VIEW_TYPE_2D)),
      static_depth(gpu, target_desc({side, side}, 1, kShadowFormat, kDepth | kSource)),
      static_view(make_view(gpu, static_depth, VK_IMAGE_VIEW_TYPE_2D)) {}

void begin_rendering(VkCommandBuffer commands, VkExtent2D extent, std::uint32_t layers, const Attachment* colour,
                     const Attachment* depth) {
  VkRenderingAttachmentInfo colour_info{}, depth_info{};
  if (colour != nullptr) colour_info = attachment_info(*colour, ImageUse::colour_target);
  if (depth != nullptr) depth_info = attachment_info(*depth, ImageUse::depth_target);
  const VkRenderingInfo info{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                             .renderArea = {{0, 0}, extent},
                             .layerCount = layers,
                             .colorAttachmentCount = colour != nullptr ? 1u : 0u,
                             .pColorAttachments = &colour_info,
                             .pDepthAttachment = depth != nullptr ? &depth_info : nullptr};
  vkCmdBeginRendering(commands, &info);
  const VkViewport viewport{0.0f, 0.0f, static_cast<float>(extent.width), static_cast<float>(extent.height),
                            0.0f, 1.0f};
  const VkRect2D scissor{{0, 0}, extent};
  vkCmdSetViewport(commands, 0, 1, &viewport);
  vkCmdSetScissor(commands, 0, 1, &scissor);
}

}  // namespace gearshift::engine
