#include "engine/xr/headset_images.h"

#include <algorithm>

namespace gearshift {
namespace {

constexpr XrDuration kAtTheEnd = 100'000'000;  // [ns] longer than a frame of any headset

bool is_depth(VkFormat format) {
  return format == VK_FORMAT_D32_SFLOAT;
}

VkFormat choose_picture_format(XrSession session, const Gpu& gpu, std::span<const VkFormat> wanted) {
  const auto offered = list_of<std::int64_t>("xrEnumerateSwapchainFormats", 0,
                                             [&](std::uint32_t room, std::uint32_t* count, std::int64_t* items) {
                                               return xrEnumerateSwapchainFormats(session, room, count, items);
                                             });
  for (const VkFormat format : wanted) {
    const bool is_offered = std::find(offered.begin(), offered.end(), format) != offered.end();
    const bool is_written = gpu.supports(
        format, is_depth(format) ? VK_FORMAT_FEATURE_2_TRANSFER_DST_BIT : VK_FORMAT_FEATURE_2_BLIT_DST_BIT);
    if (is_offered && is_written) return format;
  }
  throw HeadsetError(is_depth(wanted.front()) ? "the headset takes no depth of 32 bits"
                                              : "the headset takes no picture of 8 bits in sRGB or 16 bits a channel");
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
        [&](std::uint32_t room, std::uint32_t* count, XrSwapchainImageVulkanKHR* items) {
          return xrEnumerateSwapchainImages(swapchain_, room, count,
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

// An error in the middle of a frame leaves an image in our hands: it is given back first, as well as may be.
HeadsetImages::~HeadsetImages() {
  if (hold_ == Hold::acquired) {
    XrSwapchainImageWaitInfo wait{XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO};
    wait.timeout = kAtTheEnd;
    if (xrWaitSwapchainImage(swapchain_, &wait) == XR_SUCCESS) hold_ = Hold::ours;
  }
  const XrSwapchainImageReleaseInfo release{XR_TYPE_SWAPCHAIN_IMAGE_RELEASE_INFO};
  if (hold_ == Hold::ours) xrReleaseSwapchainImage(swapchain_, &release);
  xrDestroySwapchain(swapchain_);
}

GpuImage* HeadsetImages::take(XrDuration patience) {
  if (hold_ == Hold::none) {
    const XrSwapchainImageAcquireInfo acquire{XR_TYPE_SWAPCHAIN_IMAGE_ACQUIRE_INFO};
    check(xrAcquireSwapchainImage(swapchain_, &acquire, &index_), "xrAcquireSwapchainImage");
    hold_ = Hold::acquired;
  }
  if (hold_ == Hold::acquired) {
    XrSwapchainImageWaitInfo wait{XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO};
    wait.timeout = patience;
    const XrResult result = xrWaitSwapchainImage(swapchain_, &wait);
    check(result, "xrWaitSwapchainImage");
    if (result == XR_TIMEOUT_EXPIRED) return nullptr;
    hold_ = Hold::ours;
  }
  GpuImage& image = images_[index_];
  forget(image);
  return &image;
}

// The runtime gets and gives its images as attachments (XR_KHR_vulkan_enable2, "Swapchain Image Layout").
void HeadsetImages::ready_to_give(VkCommandBuffer commands) {
  if (hold_ != Hold::ours) return;
  GpuImage& image = images_[index_];
  transition(commands, image, is_depth(image.desc().format) ? ImageUse::depth_target : ImageUse::colour_target);
}

void HeadsetImages::give() {
  if (hold_ != Hold::ours) return;
  const XrSwapchainImageReleaseInfo release{XR_TYPE_SWAPCHAIN_IMAGE_RELEASE_INFO};
  check(xrReleaseSwapchainImage(swapchain_, &release), "xrReleaseSwapchainImage");
  hold_ = Hold::none;
  ever_given_ = true;
}

XrSwapchainSubImage HeadsetImages::layer(std::uint32_t index) const noexcept {
  return {swapchain_, {{0, 0}, {size_.x, size_.y}}, index};
}

}  // namespace gearshift
