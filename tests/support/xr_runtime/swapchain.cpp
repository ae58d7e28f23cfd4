// Swapchains: the program acquires their images in turn.
#include <algorithm>

#include "tests/support/xr_runtime/functions.h"
#include "tests/support/xr_runtime/state.h"

namespace gearshift::xr_test {
namespace {

std::vector<std::int64_t> formats(const Script& script) {
  std::vector<std::int64_t> all = script.colour_formats;
  all.insert(all.end(), script.depth_formats.begin(), script.depth_formats.end());
  return all;
}

bool within(std::uint32_t value, std::uint32_t limit) {
  return value >= 1 && value <= limit;
}

void check_create_info(const Script& script, const XrSwapchainCreateInfo& info) {
  const std::vector<std::int64_t> known = formats(script);
  require(std::find(known.begin(), known.end(), info.format) != known.end(), "swapchain_format",
          std::to_string(info.format));
  constexpr std::uint32_t kMaxArrayLayers = 2048, kMaxMipLevels = 16;
  require(within(info.width, script.max_width) && within(info.height, script.max_height), "swapchain_size", "extent");
  require(within(info.sampleCount, script.max_samples), "swapchain_size", "sampleCount");
  require(within(info.arraySize, kMaxArrayLayers) && within(info.mipCount, kMaxMipLevels), "swapchain_size",
          "layers, levels");
  require(info.faceCount == 1 || info.faceCount == 6, "swapchain_size", "faceCount");
  const XrSwapchainUsageFlags foreign =
      is_depth(info.format) ? XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT : XR_SWAPCHAIN_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
  require((info.usageFlags & foreign) == 0, "swapchain_usage");
  constexpr XrSwapchainUsageFlags kKnown = 0x7f;
  require((info.usageFlags & ~kKnown) == 0, "swapchain_usage", "an unknown bit");
  // Rejects features that an OpenXR runtime need not support.
  if (info.faceCount != 1 || info.arraySize > 2 || (info.sampleCount & (info.sampleCount - 1)) != 0 ||
      info.createFlags != 0) {
    reject_call(XR_ERROR_FEATURE_UNSUPPORTED);
  }
}

}  // namespace

void drop_swapchain(State& s, XrSwapchain handle) {
  SwapchainObject& swapchain = *s.swapchains.find(handle);
  free_images(s.sessions.find(swapchain.session)->graphics, swapchain.images);
  s.swapchains.erase(handle);
}

namespace xr {

XrResult XRAPI_CALL EnumerateSwapchainFormats(XrSession session, std::uint32_t capacity, std::uint32_t* count,
                                              std::int64_t* list) {
  return call("xrEnumerateSwapchainFormats", [&](State& s) {
    live(session);
    return fill(capacity, count, list, formats(s.control.script));
  });
}

XrResult XRAPI_CALL CreateSwapchain(XrSession session, const XrSwapchainCreateInfo* info, XrSwapchain* swapchain) {
  return call("xrCreateSwapchain", [&](State& s) {
    const SessionObject& owner = live(session);
    check_create_info(s.control.script, *info);
    SwapchainObject created{.session = session, .info = *info};
    created.info.next = nullptr;
    created.images = make_images(owner.graphics, *info, s.control.script.images);
    *swapchain = s.swapchains.add(std::move(created));
    count_live();
    return XR_SUCCESS;
  });
}

XrResult XRAPI_CALL DestroySwapchain(XrSwapchain swapchain) {
  return call("xrDestroySwapchain", [&](State& s) {
    const SwapchainObject* const object = s.swapchains.find(swapchain);
    if (!object->acquired.empty()) write_violation("destroyed_in_use", {});  // the swapchain is destroyed anyway
    drop_swapchain(s, swapchain);
    count_live();
    return XR_SUCCESS;
  });
}

XrResult XRAPI_CALL EnumerateSwapchainImages(XrSwapchain swapchain, std::uint32_t capacity, std::uint32_t* count,
                                             XrSwapchainImageBaseHeader* images) {
  return call("xrEnumerateSwapchainImages", [&](State&) {
    const SwapchainObject& object = live(swapchain);
    auto* const out = reinterpret_cast<XrSwapchainImageVulkanKHR*>(images);
    return fill(capacity, count, out, object.images,
                [](XrSwapchainImageVulkanKHR& to, const SwapchainImage& from) { to.image = from.image; });
  });
}

XrResult XRAPI_CALL AcquireSwapchainImage(XrSwapchain swapchain, const XrSwapchainImageAcquireInfo*,
                                          std::uint32_t* index) {
  return call("xrAcquireSwapchainImage", [&](State& s) {
    SwapchainObject& object = live(swapchain);
    require(object.acquired.size() < object.images.size(), "acquire_order");
    *index = object.next;
    object.next = (object.next + 1) % static_cast<std::uint32_t>(object.images.size());
    object.acquired.push_back(*index);
    set_initial_layout(s.sessions.find(object.session)->graphics, object.images[*index], object.info);
    return XR_SUCCESS;
  });
}

XrResult XRAPI_CALL WaitSwapchainImage(XrSwapchain swapchain, const XrSwapchainImageWaitInfo*) {
  return call("xrWaitSwapchainImage", [&](State&) {
    SwapchainObject& object = live(swapchain);
    require(!object.acquired.empty() && !object.waited, "image_wait_order");
    object.waited = true;
    return XR_SUCCESS;
  });
}

XrResult XRAPI_CALL ReleaseSwapchainImage(XrSwapchain swapchain, const XrSwapchainImageReleaseInfo*) {
  return call("xrReleaseSwapchainImage", [&](State&) {
    SwapchainObject& object = live(swapchain);
    require(object.waited, "release_order");
    object.released = object.acquired.front();
    object.acquired.pop_front();
    object.waited = false;
    return XR_SUCCESS;
  });
}

}  // namespace xr
}  // namespace gearshift::xr_test
