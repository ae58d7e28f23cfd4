// A render target with depth. Tests draw into it and read it back.
#pragma once

#include <functional>

#include "engine/gpu/commands.h"
#include "engine/gpu/gpu_image.h"

namespace gearshift::test {

struct Canvas {
  Canvas(engine::Gpu& device, std::uint32_t width, std::uint32_t height)
      : gpu(device),
        colour(gpu, {.width = width,
                     .height = height,
                     .format = VK_FORMAT_R8G8B8A8_UNORM,
                     .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                              VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_SAMPLED_BIT}),
        depth(gpu, {.width = width,
                    .height = height,
                    .format = VK_FORMAT_D32_SFLOAT,
                    .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT}),
        colour_view(engine::make_view(gpu, colour, VK_IMAGE_VIEW_TYPE_2D)),
        depth_view(engine::make_view(gpu, depth, VK_IMAGE_VIEW_TYPE_2D)) {}

  // Clears colour to `clear` and depth to 0 (far), then draws, without culling.
  void draw(
      VkCommandBuffer commands, std::array<float, 4> clear, const std::function<void()>& triangles = [] {}) {
    engine::transition(commands, colour, engine::ImageUse::colour_target);
    engine::transition(commands, depth, engine::ImageUse::depth_target);
    const auto attachment = [](const engine::ImageView& view, engine::ImageUse use, VkClearValue value) {
      return VkRenderingAttachmentInfo{.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                       .imageView = view.get(),
                                       .imageLayout = engine::layout_of(use),
                                       .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
                                       .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
                                       .clearValue = value};
    };
    const auto on_colour = attachment(colour_view, engine::ImageUse::colour_target,
                                      {.color = {.float32 = {clear[0], clear[1], clear[2], clear[3]}}});
    const auto on_depth = attachment(depth_view, engine::ImageUse::depth_target, {});
    const VkRect2D all{.extent = colour.extent()};
    const VkRenderingInfo info{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                               .renderArea = all,
                               .layerCount = 1,
                               .colorAttachmentCount = 1,
                               .pColorAttachments = &on_colour,
                               .pDepthAttachment = &on_depth};
    vkCmdBeginRendering(commands, &info);
    const VkViewport viewport{.width = static_cast<float>(all.extent.width),
                              .height = static_cast<float>(all.extent.height),
                              .maxDepth = 1.0f};
    vkCmdSetViewport(commands, 0, 1, &viewport);
    vkCmdSetScissor(commands, 0, 1, &all);
    vkCmdSetCullMode(commands, VK_CULL_MODE_NONE);
    vkCmdSetFrontFace(commands, VK_FRONT_FACE_COUNTER_CLOCKWISE);
    triangles();
    vkCmdEndRendering(commands);
  }

  engine::Gpu& gpu;
  engine::GpuImage colour, depth;
  engine::ImageView colour_view, depth_view;
};

}  // namespace gearshift::test
