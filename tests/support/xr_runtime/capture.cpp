// Reads the pixels of a submitted frame through the program's Vulkan queue, which xrEndFrame may use.
#include <algorithm>
#include <cstring>

#include "tests/support/xr_runtime/state.h"

namespace gearshift::xr_test {
namespace {

bool should_capture(const Capture& capture, std::uint64_t frame) {
  const bool every = capture.every > 0 && frame % static_cast<std::uint64_t>(capture.every) == 0;
  return every || std::find(capture.only.begin(), capture.only.end(), frame) != capture.only.end();
}

// Reads the pixels that the program submitted. Returns no bytes for a multisampled image, which cannot be copied.
std::vector<std::uint8_t> read_submitted(const SessionObject& session, const XrSwapchainSubImage& sub) {
  const SwapchainObject& swapchain = live(sub.swapchain);
  if (swapchain.info.sampleCount != 1) return {};
  const auto [offset, extent] = sub.imageRect;
  const ReadRegion region{offset.x, offset.y, static_cast<std::uint32_t>(extent.width),
                          static_cast<std::uint32_t>(extent.height), sub.imageArrayIndex};
  return read_pixels(session.graphics, swapchain.images[*swapchain.released].image, swapchain.info.format, region);
}

bool is_bgra(std::int64_t format) {
  return format == VK_FORMAT_B8G8R8A8_SRGB || format == VK_FORMAT_B8G8R8A8_UNORM;
}

bool is_rgba(std::int64_t format) {
  return format == VK_FORMAT_R8G8B8A8_SRGB || format == VK_FORMAT_R8G8B8A8_UNORM;
}

engine::Image picture(const SessionObject& session, const XrSwapchainSubImage& sub) {
  const std::int64_t format = live(sub.swapchain).info.format;
  if (!is_rgba(format) && !is_bgra(format)) return {};
  engine::Image image{sub.imageRect.extent.width, sub.imageRect.extent.height, read_submitted(session, sub)};
  if (image.rgba.empty()) return {};
  if (is_bgra(format)) {
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) std::swap(image.rgba[i], image.rgba[i + 2]);
  }
  return image;
}

std::vector<float> depths(const SessionObject& session, const XrSwapchainSubImage& sub) {
  if (live(sub.swapchain).info.format != VK_FORMAT_D32_SFLOAT) return {};
  const std::vector<std::uint8_t> bytes = read_submitted(session, sub);
  std::vector<float> values(bytes.size() / sizeof(float));
  std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

}  // namespace

void capture_frame(State& s, const XrFrameEndInfo& info, const SessionObject& session, FrameRecord& record) {
  const Capture& capture = s.control.script.capture;
  if (!should_capture(capture, record.index)) return;
  for (std::uint32_t i = 0; i < info.layerCount; ++i) {
    std::vector<ViewRecord>& views = record.layers[i].views;
    if (record.layers[i].type == XR_TYPE_COMPOSITION_LAYER_QUAD) {
      views[0].picture = picture(session, reinterpret_cast<const XrCompositionLayerQuad*>(info.layers[i])->subImage);
      continue;
    }
    const auto& layer = reinterpret_cast<const XrCompositionLayerProjection&>(*info.layers[i]);
    for (std::uint32_t eye = 0; eye < layer.viewCount; ++eye) {
      views[eye].picture = picture(session, layer.views[eye].subImage);
      const void* const depth = find_chained(&layer.views[eye], XR_TYPE_COMPOSITION_LAYER_DEPTH_INFO_KHR);
      if (depth == nullptr || !capture.depth) continue;
      views[eye].depth.values = depths(session, static_cast<const XrCompositionLayerDepthInfoKHR*>(depth)->subImage);
    }
  }
}

}  // namespace gearshift::xr_test
