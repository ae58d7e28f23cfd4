#include "app/view/ui_canvas.h"

#include "engine/render/targets.h"

namespace gearshift {

void UiCanvas::fit(VkExtent2D extent) {
  if (image_.get() != VK_NULL_HANDLE && image_.extent().width == extent.width &&
      image_.extent().height == extent.height)
    return;
  gpu_.wait_idle();  // frames in flight
  ImageDesc desc{.width = extent.width, .height = extent.height, .format = kColourFormat};
  desc.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  desc.also = kOverlayFormat;
  GpuImage made(gpu_, desc);
  view_ = make_view(gpu_, made, VK_IMAGE_VIEW_TYPE_2D, 0, 1, kOverlayFormat);
  image_ = std::move(made);
}

GpuImage& UiCanvas::begin(VkCommandBuffer commands) {
  forget(image_);
  transition(commands, image_, ImageUse::copy_to);
  const VkClearColorValue nothing{};
  const VkImageSubresourceRange all{.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .levelCount = 1, .layerCount = 1};
  vkCmdClearColorImage(commands, image_.get(), layout_of(ImageUse::copy_to), &nothing, 1, &all);
  transition(commands, image_, ImageUse::copy_to);  // what is copied comes after
  return image_;
}

GpuImage& UiCanvas::draw(VkCommandBuffer commands, int slot) {
  transition(commands, image_, ImageUse::colour_target);
  const Attachment colour{.view = view_.get(), .load = VK_ATTACHMENT_LOAD_OP_LOAD};
  begin_rendering(commands, image_.extent(), 1, &colour, nullptr);
  overlay_.draw(commands, image_.extent(), slot);
  vkCmdEndRendering(commands);
  transition(commands, image_, ImageUse::copy_from);
  return image_;
}

}  // namespace gearshift
