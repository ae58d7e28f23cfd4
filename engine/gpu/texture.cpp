// Uploads images to the device and reads them back.
#include <algorithm>
#include <bit>
#include <cstring>
#include <stdexcept>

#include "engine/gpu/commands.h"
#include "engine/gpu/gpu_buffer.h"
#include "engine/gpu/gpu_image.h"

namespace gearshift::engine {
namespace {

constexpr VkImageUsageFlags kTextureUsage =
    VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;

std::uint32_t side_at(std::uint32_t side, std::uint32_t level) {
  return std::max(side >> level, 1u);
}

VkBufferImageCopy level_copy(const GpuImage& image, std::uint32_t level, VkDeviceSize offset) {
  return {.bufferOffset = offset,
          .imageSubresource = {.aspectMask = image.aspect(), .mipLevel = level, .layerCount = image.desc().layers},
          .imageExtent = {side_at(image.desc().width, level), side_at(image.desc().height, level), 1}};
}

// Fills a mip level from the next larger level. Each texel is the mean of four texels of that level.
void blit_level(VkCommandBuffer commands, GpuImage& image, std::uint32_t level) {
  transition(commands, image, ImageUse::copy_from, level - 1, 1);
  transition(commands, image, ImageUse::copy_to, level, 1);
  const auto corner = [&](std::uint32_t l) {
    return VkOffset3D{static_cast<std::int32_t>(side_at(image.desc().width, l)),
                      static_cast<std::int32_t>(side_at(image.desc().height, l)), 1};
  };
  const auto part = [&](std::uint32_t l) {
    return VkImageSubresourceLayers{.aspectMask = image.aspect(), .mipLevel = l, .layerCount = image.desc().layers};
  };
  const VkImageBlit blit{.srcSubresource = part(level - 1),
                         .srcOffsets = {{}, corner(level - 1)},
                         .dstSubresource = part(level),
                         .dstOffsets = {{}, corner(level)}};
  vkCmdBlitImage(commands, image.get(), layout_of(ImageUse::copy_from), image.get(), layout_of(ImageUse::copy_to), 1,
                 &blit, VK_FILTER_LINEAR);
}

}  // namespace

GpuImage make_texture(Gpu& gpu, const Image& pixels, bool srgb, bool mips) {
  ImageDesc desc{.width = static_cast<std::uint32_t>(pixels.width),
                 .height = static_cast<std::uint32_t>(pixels.height),
                 .format = srgb ? VK_FORMAT_R8G8B8A8_SRGB : VK_FORMAT_R8G8B8A8_UNORM,
                 .usage = kTextureUsage};
  const bool can_blit = gpu.supports(desc.format, VK_FORMAT_FEATURE_2_BLIT_SRC_BIT | VK_FORMAT_FEATURE_2_BLIT_DST_BIT |
                                                      VK_FORMAT_FEATURE_2_SAMPLED_IMAGE_FILTER_LINEAR_BIT);
  if (mips && can_blit) desc.levels = static_cast<std::uint32_t>(std::bit_width(std::max(desc.width, desc.height)));
  GpuImage image(gpu, desc);
  GpuBuffer staging(gpu, pixels.rgba.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT, MemoryKind::upload);
  std::memcpy(staging.mapped(), pixels.rgba.data(), pixels.rgba.size());
  run_once(gpu, [&](VkCommandBuffer commands) {
    transition(commands, image, ImageUse::copy_to, 0, 1);
    const VkBufferImageCopy copy = level_copy(image, 0, 0);
    vkCmdCopyBufferToImage(commands, staging.get(), image.get(), layout_of(ImageUse::copy_to), 1, &copy);
    for (std::uint32_t level = 1; level < desc.levels; ++level) blit_level(commands, image, level);
    transition(commands, image, ImageUse::sampled);
  });
  return image;
}

GpuImage make_texture(Gpu& gpu, const ImageDesc& desc, std::span<const std::vector<std::byte>> levels) {
  if (levels.size() != desc.levels)
    throw std::logic_error("The number of mip levels differs from the texture's description.");
  ImageDesc full = desc;
  full.usage |= kTextureUsage;
  GpuImage image(gpu, full);
  std::size_t size = 0;
  // Copy offsets must be multiples of the texel size, which is at most 16 bytes. So each size is rounded up to 16
  // bytes.
  for (const auto& level : levels) size += (level.size() + 15) / 16 * 16;
  GpuBuffer staging(gpu, size, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, MemoryKind::upload);
  std::vector<VkBufferImageCopy> copies;
  std::size_t offset = 0;
  for (std::uint32_t level = 0; level < desc.levels; ++level) {
    std::memcpy(staging.mapped() + offset, levels[level].data(), levels[level].size());
    copies.push_back(level_copy(image, level, offset));
    offset += (levels[level].size() + 15) / 16 * 16;
  }
  run_once(gpu, [&](VkCommandBuffer commands) {
    transition(commands, image, ImageUse::copy_to);
    vkCmdCopyBufferToImage(commands, staging.get(), image.get(), layout_of(ImageUse::copy_to), desc.levels,
                           copies.data());
    transition(commands, image, ImageUse::sampled);
  });
  return image;
}

void copy_image(VkCommandBuffer commands, const GpuImage& from, const GpuImage& to) {
  expect(from, ImageUse::copy_from);
  expect(to, ImageUse::copy_to);
  const auto [width, height] = from.extent();
  const VkImageSubresourceLayers layers{.aspectMask = from.aspect(), .layerCount = from.desc().layers};
  if (from.desc().format == to.desc().format) {
    const VkImageCopy copy{.srcSubresource = layers, .dstSubresource = layers, .extent = {width, height, 1}};
    vkCmdCopyImage(commands, from.get(), layout_of(ImageUse::copy_from), to.get(), layout_of(ImageUse::copy_to), 1,
                   &copy);
    return;
  }
  const VkOffset3D end{static_cast<std::int32_t>(width), static_cast<std::int32_t>(height), 1};
  const VkImageBlit blit{
      .srcSubresource = layers, .srcOffsets = {{}, end}, .dstSubresource = layers, .dstOffsets = {{}, end}};
  vkCmdBlitImage(commands, from.get(), layout_of(ImageUse::copy_from), to.get(), layout_of(ImageUse::copy_to), 1, &blit,
                 VK_FILTER_NEAREST);
}

void blit_into(VkCommandBuffer commands, const GpuImage& from, std::uint32_t layer, const GpuImage& to,
               const VkRect2D& place) {
  const auto [width, height] = from.extent();
  const auto left = place.offset.x, top = place.offset.y;
  const auto right = left + static_cast<std::int32_t>(place.extent.width);
  const auto bottom = top + static_cast<std::int32_t>(place.extent.height);
  const VkImageBlit blit{
      .srcSubresource = {.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .baseArrayLayer = layer, .layerCount = 1},
      .srcOffsets = {{}, {static_cast<std::int32_t>(width), static_cast<std::int32_t>(height), 1}},
      .dstSubresource = {.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .layerCount = 1},
      .dstOffsets = {{left, top, 0}, {right, bottom, 1}}};
  const bool is_same_size = place.extent.width == width && place.extent.height == height;
  vkCmdBlitImage(commands, from.get(), layout_of(ImageUse::copy_from), to.get(), layout_of(ImageUse::copy_to), 1, &blit,
                 is_same_size ? VK_FILTER_NEAREST : VK_FILTER_LINEAR);
}

void make_copies_visible_to_host(VkCommandBuffer commands) {
  const VkMemoryBarrier2 to_host{.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
                                 .srcStageMask = VK_PIPELINE_STAGE_2_COPY_BIT,
                                 .srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT,
                                 .dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT,
                                 .dstAccessMask = VK_ACCESS_2_HOST_READ_BIT};
  const VkDependencyInfo dependency{
      .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .memoryBarrierCount = 1, .pMemoryBarriers = &to_host};
  vkCmdPipelineBarrier2(commands, &dependency);
}

Image read_back(Gpu& gpu, GpuImage& image, std::uint32_t layer) {
  const auto [width, height] = image.extent();
  Image pixels{.width = static_cast<int>(width), .height = static_cast<int>(height), .rgba = {}};
  pixels.rgba.resize(std::size_t{4} * width * height);
  GpuBuffer staging(gpu, pixels.rgba.size(), VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryKind::read_back);
  run_once(gpu, [&](VkCommandBuffer commands) {
    transition(commands, image, ImageUse::copy_from);
    VkBufferImageCopy copy = level_copy(image, 0, 0);
    copy.imageSubresource.baseArrayLayer = layer;
    copy.imageSubresource.layerCount = 1;
    vkCmdCopyImageToBuffer(commands, image.get(), layout_of(ImageUse::copy_from), staging.get(), 1, &copy);
    make_copies_visible_to_host(commands);
  });
  std::memcpy(pixels.rgba.data(), staging.mapped(), pixels.rgba.size());
  return pixels;
}

}  // namespace gearshift::engine
