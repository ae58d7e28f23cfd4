#include "engine/gpu/gpu_image.h"

#include <algorithm>
#include <array>
#include <utility>

namespace gearshift::engine {
namespace {

VkImage make_image(VkDevice device, const ImageDesc& desc) {
  const std::array<VkFormat, 2> formats{desc.format, desc.second_format};
  const VkImageFormatListCreateInfo list{
      .sType = VK_STRUCTURE_TYPE_IMAGE_FORMAT_LIST_CREATE_INFO, .viewFormatCount = 2, .pViewFormats = formats.data()};
  const bool two_formats = desc.second_format != VK_FORMAT_UNDEFINED;
  const VkImageCreateFlags cube = desc.cube ? VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT : 0;
  const VkImageCreateFlags mutable_format = two_formats ? VK_IMAGE_CREATE_MUTABLE_FORMAT_BIT : 0;
  const VkImageCreateInfo info{.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                               .pNext = two_formats ? &list : nullptr,
                               .flags = cube | mutable_format,
                               .imageType = VK_IMAGE_TYPE_2D,
                               .format = desc.format,
                               .extent = {desc.width, desc.height, 1},
                               .mipLevels = desc.levels,
                               .arrayLayers = desc.layers,
                               .samples = desc.samples,
                               .tiling = VK_IMAGE_TILING_OPTIMAL,
                               .usage = desc.usage};
  VkImage image = VK_NULL_HANDLE;
  check(vkCreateImage(device, &info, nullptr, &image), "vkCreateImage");
  return image;
}

}  // namespace

GpuImage::GpuImage(Gpu& gpu, const ImageDesc& desc)
    : gpu_(&gpu), image_(make_image(gpu.device(), desc)), desc_(desc), states_(desc.levels) {
  VkMemoryRequirements needs;
  vkGetImageMemoryRequirements(gpu.device(), image_, &needs);
  try {
    allocation_ = gpu.allocate(needs, MemoryKind::device, MemoryUser::image);
    check(vkBindImageMemory(gpu.device(), image_, allocation_.memory, allocation_.offset), "vkBindImageMemory");
  } catch (...) {
    vkDestroyImage(gpu.device(), image_, nullptr);
    gpu.free(allocation_);
    throw;
  }
}

GpuImage::GpuImage(VkImage foreign, const ImageDesc& desc) : image_(foreign), desc_(desc), states_(desc.levels) {}

GpuImage::GpuImage(GpuImage&& other) noexcept {
  *this = std::move(other);
}

GpuImage& GpuImage::operator=(GpuImage&& other) noexcept {
  std::swap(gpu_, other.gpu_);
  std::swap(image_, other.image_);
  std::swap(desc_, other.desc_);
  std::swap(allocation_, other.allocation_);
  std::swap(states_, other.states_);
  return *this;
}

GpuImage::~GpuImage() {
  if (gpu_ == nullptr) return;
  vkDestroyImage(gpu_->device(), image_, nullptr);
  gpu_->free(allocation_);
}

VkImageAspectFlags GpuImage::aspect() const noexcept {
  switch (desc_.format) {
    case VK_FORMAT_D16_UNORM:
    case VK_FORMAT_X8_D24_UNORM_PACK32:
    case VK_FORMAT_D32_SFLOAT:
      return VK_IMAGE_ASPECT_DEPTH_BIT;
    default:
      return VK_IMAGE_ASPECT_COLOR_BIT;
  }
}

ImageView make_view(const Gpu& gpu, const GpuImage& image, VkImageViewType type, std::uint32_t first_layer,
                    std::uint32_t layer_count, VkFormat format) {
  const VkImageViewCreateInfo info{.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                   .image = image.get(),
                                   .viewType = type,
                                   .format = format == VK_FORMAT_UNDEFINED ? image.desc().format : format,
                                   .subresourceRange = {.aspectMask = image.aspect(),
                                                        .levelCount = image.desc().levels,
                                                        .baseArrayLayer = first_layer,
                                                        .layerCount = layer_count}};
  VkImageView view = VK_NULL_HANDLE;
  check(vkCreateImageView(gpu.device(), &info, nullptr, &view), "vkCreateImageView");
  return {gpu.device(), view};
}

Sampler make_sampler(const Gpu& gpu, const SamplerDesc& desc) {
  const VkFilter filter = desc.linear ? VK_FILTER_LINEAR : VK_FILTER_NEAREST;
  const float anisotropy = desc.anisotropic ? std::min(8.0f, gpu.traits().max_anisotropy) : 1.0f;
  const VkSamplerCreateInfo info{
      .sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
      .magFilter = filter,
      .minFilter = filter,
      .mipmapMode = desc.linear ? VK_SAMPLER_MIPMAP_MODE_LINEAR : VK_SAMPLER_MIPMAP_MODE_NEAREST,
      .addressModeU = desc.u,
      .addressModeV = desc.v,
      .addressModeW = desc.u,
      .anisotropyEnable = anisotropy > 1.0f ? VK_TRUE : VK_FALSE,
      .maxAnisotropy = anisotropy,
      .compareEnable = desc.compare ? VK_TRUE : VK_FALSE,
      .compareOp = VK_COMPARE_OP_GREATER_OR_EQUAL,
      .maxLod = desc.mips ? VK_LOD_CLAMP_NONE : 0.0f};
  VkSampler sampler = VK_NULL_HANDLE;
  check(vkCreateSampler(gpu.device(), &info, nullptr, &sampler), "vkCreateSampler");
  return {gpu.device(), sampler};
}

}  // namespace gearshift::engine
