#include "app/cabin/view/ui_canvas.h"

#include "engine/render/targets.h"

namespace gearshift::cabin {

void UiCanvas::fit(VkExtent2D extent) {
  if (image_.get() != VK_NULL_HANDLE && image_.extent().width == extent.width &&
      image_.extent().height == extent.height)
    return;
  gpu_.wait_idle();  // frames in flight may still use the old image
  engine::ImageDesc desc{.width = extent.width, .height = extent.height, .format = engine::kColourFormat};
  desc.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  desc.second_format = engine::kOverlayFormat;
  engine::GpuImage image(gpu_, desc);
  view_ = engine::make_view(gpu_, image, VK_IMAGE_VIEW_TYPE_2D, 0, 1, engine::kOverlayFormat);
  image_ = std::move(image);
}

engine::GpuImage& UiCanvas::begin(VkCommandBuffer commands) {
  engine::discard_content(image_);
  engine::transition(commands, image_, engine::ImageUse::copy_to);
  const VkClearColorValue nothing{};
  const VkImageSubresourceRange all{.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .levelCount = 1, .layerCount = 1};
  vkCmdClearColorImage(commands, image_.get(), engine::layout_of(engine::ImageUse::copy_to), &nothing, 1, &all);
  engine::transition(commands, image_, engine::ImageUse::copy_to);  // makes later copies wait for the clear
  return image_;
}

engine::GpuImage& UiCanvas::draw(VkCommandBuffer commands, int slot) {
  engine::transition(commands, image_, engine::ImageUse::colour_target);
  const engine::Attachment colour{.view = view_.get(), .load = VK_ATTACHMENT_LOAD_OP_LOAD};
  engine::begin_rendering(commands, image_.extent(), 1, &colour, nullptr);
  overlay_.draw(commands, image_.extent(), slot);
  vkCmdEndRendering(commands);
  engine::transition(commands, image_, engine::ImageUse::copy_from);
  return image_;
}

}  // namespace gearshift::cabin
