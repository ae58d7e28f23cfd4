#include "engine/xr/headset_images.h"

#include <algorithm>

namespace gearshift::engine {
namespace {

constexpr XrDuration kDestructionTimeout = 100'000'000;  // [ns] longest wait; exceeds the frame time of any headset

bool is_depth(VkFormat format) {
  return format == VK_FORMAT_D32_SFLOAT;
}

VkFormat choose_picture_format(XrSession session, const Gpu& gpu, std::span<const VkFormat> wanted) {
  const auto offered = list_of<std::int64_t>("xrEnumerateSwapchainFormats", 0,
                                             [&](std::uint32_t capacity, std::uint32_t* count, std::int64_t* items) {
                                               return xrEnumerateSwapchainFormats(session, capacity, count, items);
                                             });
  for (const VkFormat format : wanted) {
    const bool is_offered = std::find(offered.begin(), offered.end(), format) != offered.end();
    const bool is_writable = gpu.supports(
        format, is_depth(format) ? VK_FORMAT_FEATURE_2_TRANSFER_DST_BIT : VK_FORMAT_FEATURE_2_BLIT_DST_BIT);
    if (is_offered && is_writable) return format;
  }
  throw HeadsetError(is_depth(wanted.front()) ? "the headset does not accept 32-bit depth images"
                                              : "the headset accepts neither 8-bit sRGB nor 16-bit float images");
}

}  // namespace

HeadsetImages::HeadsetImages(XrSession session, const Gpu& gpu, glm::ivec2 size, std::uint32_t layers,
                             std::span<const VkFormat> wanted)
    : size_(size) {
  const VkFormat format = choose_picture_format(session, gpu, wanted);
  XrSwapchainCreateInfo info{XR_TYPE_SWAPCHAIN_CREATE_INFO};
  info.usageFlags =
      XR_SWAPCHAIN_USAGE_TRANSFER_DST_BIT |
      (is_depth(format) ? XR_SWAPCHAIN_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT : XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT);
  info.format = format;
  info.sampleCount = 1;
  info.width = static_cast<std::uint32_t>(size.x);
  info.height = static_cast<std::uint32_t>(size.y);
  info.faceCount = 1;
  info.arraySize = layers;
  info.mipCount = 1;
  check(xrCreateSwapchain(session, &info, &swapchain_), "xrCreateSwapchain");
  try {
    const auto raw = list_of<XrSwapchainImageVulkanKHR>(
        "xrEnumerateSwapchainImages", {XR_TYPE_SWAPCHAIN_IMAGE_VULKAN_KHR},
        [&](std::uint32_t capacity, std::uint32_t* count, XrSwapchainImageVulkanKHR* items) {
          return xrEnumerateSwapchainImages(swapchain_, capacity, count,
                                            reinterpret_cast<XrSwapchainImageBaseHeader*>(items));
        });
    for (const XrSwapchainImageVulkanKHR& image : raw)
      images_.emplace_back(image.image,
                           ImageDesc{.width = info.width, .height = info.height, .layers = layers, .format = format});
  } catch (...) {
    xrDestroySwapchain(swapchain_);
    throw;
  }
}

// An exception in the middle of a frame can leave an image acquired. Before the swapchain is destroyed, that image is
// waited for and released, if possible.
HeadsetImages::~HeadsetImages() {
  if (image_state_ == ImageState::acquired) {
    XrSwapchainImageWaitInfo wait{XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO};
    wait.timeout = kDestructionTimeout;
    if (xrWaitSwapchainImage(swapchain_, &wait) == XR_SUCCESS) image_state_ = ImageState::waited;
  }
  const XrSwapchainImageReleaseInfo release{XR_TYPE_SWAPCHAIN_IMAGE_RELEASE_INFO};
  if (image_state_ == ImageState::waited) xrReleaseSwapchainImage(swapchain_, &release);
  xrDestroySwapchain(swapchain_);
}

GpuImage* HeadsetImages::acquire(XrDuration timeout) {
  if (image_state_ == ImageState::none) {
    const XrSwapchainImageAcquireInfo acquire{XR_TYPE_SWAPCHAIN_IMAGE_ACQUIRE_INFO};
    check(xrAcquireSwapchainImage(swapchain_, &acquire, &index_), "xrAcquireSwapchainImage");
    image_state_ = ImageState::acquired;
  }
  if (image_state_ == ImageState::acquired) {
    XrSwapchainImageWaitInfo wait{XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO};
    wait.timeout = timeout;
    const XrResult result = xrWaitSwapchainImage(swapchain_, &wait);
    check(result, "xrWaitSwapchainImage");
    if (result == XR_TIMEOUT_EXPIRED) return nullptr;
    image_state_ = ImageState::waited;
  }
  GpuImage& image = images_[index_];
  discard_content(image);
  return &image;
}

// The runtime provides its images in attachment layout and expects them back in the same layout (XR_KHR_vulkan_enable2,
// "Swapchain Image Layout").
void HeadsetImages::transition_for_release(VkCommandBuffer commands) {
  if (image_state_ != ImageState::waited) return;
  GpuImage& image = images_[index_];
  transition(commands, image, is_depth(image.desc().format) ? ImageUse::depth_target : ImageUse::colour_target);
}

void HeadsetImages::release() {
  if (image_state_ != ImageState::waited) return;
  const XrSwapchainImageReleaseInfo release{XR_TYPE_SWAPCHAIN_IMAGE_RELEASE_INFO};
  check(xrReleaseSwapchainImage(swapchain_, &release), "xrReleaseSwapchainImage");
  image_state_ = ImageState::none;
  has_been_released_ = true;
}

XrSwapchainSubImage HeadsetImages::layer(std::uint32_t index) const noexcept {
  return {swapchain_, {{0, 0}, {size_.x, size_.y}}, index};
}

}  // namespace gearshift::engine
