#include "tests/support/xr_runtime/layers.h"

#include <cmath>
#include <numbers>

namespace gearshift::xr_test {
namespace {

Rect check_image(const XrSwapchainSubImage& image) {
  const SwapchainObject& swapchain = live(image.swapchain);
  require(swapchain.released.has_value(), "image_released");
  require(swapchain.acquired.empty(), "image_held");
  require(image.imageArrayIndex < swapchain.info.arraySize, "image_array_index", std::to_string(image.imageArrayIndex));
  const auto [offset, extent] = image.imageRect;
  const bool inside = offset.x >= 0 && offset.y >= 0 && extent.width > 0 && extent.height > 0 &&
                      offset.x + extent.width <= static_cast<int>(swapchain.info.width) &&
                      offset.y + extent.height <= static_cast<int>(swapchain.info.height);
  require(inside, "image_rect");
  return {offset.x, offset.y, extent.width, extent.height};
}

Fov check_fov(const XrFovf& fov) {
  constexpr float kMaxFovAngle = std::numbers::pi_v<float> / 2.0f;
  for (const float angle : {fov.angleLeft, fov.angleRight, fov.angleUp, fov.angleDown}) {
    require(std::isfinite(angle) && std::abs(angle) < kMaxFovAngle, "fov");
  }
  require(fov.angleLeft != fov.angleRight && fov.angleUp != fov.angleDown, "fov", "spans nothing");
  return {fov.angleLeft, fov.angleRight, fov.angleUp, fov.angleDown};
}

DepthRecord check_depth(const XrCompositionLayerProjectionView& view) {
  DepthRecord record;
  const auto* const depth =
      static_cast<const XrCompositionLayerDepthInfoKHR*>(find_chained(&view, XR_TYPE_COMPOSITION_LAYER_DEPTH_INFO_KHR));
  if (depth == nullptr) return record;
  record = {true, depth->minDepth, depth->maxDepth, depth->nearZ, depth->farZ, check_image(depth->subImage), {}};
  require(record.min_depth >= 0.0f && record.min_depth < record.max_depth && record.max_depth <= 1.0f, "depth_info");
  require(record.near_z >= 0.0f && record.far_z >= 0.0f && record.near_z != record.far_z, "depth_info", "nearZ, farZ");
  require(is_depth(live(depth->subImage.swapchain).info.format), "depth_info", "the format is a colour's");
  return record;
}

LayerRecord read_projection(const XrCompositionLayerProjection& layer) {
  require(layer.viewCount == 2, "view_count", std::to_string(layer.viewCount));
  LayerRecord record{.type = layer.type, .flags = layer.layerFlags, .space = live(layer.space).type};
  for (std::uint32_t i = 0; i < layer.viewCount; ++i) {
    const XrCompositionLayerProjectionView& view = layer.views[i];
    require_unit_pose(view.pose, "view");
    const Fov fov = check_fov(view.fov);
    const Rect rect = check_image(view.subImage);
    record.views.push_back({from_xr(view.pose), fov, rect, view.subImage.imageArrayIndex, check_depth(view), {}});
  }
  return record;
}

LayerRecord read_quad(const XrCompositionLayerQuad& layer) {
  require_unit_pose(layer.pose, "quad");
  LayerRecord record{.type = layer.type, .flags = layer.layerFlags, .space = live(layer.space).type};
  record.width = layer.size.width;
  record.height = layer.size.height;
  record.eyes = layer.eyeVisibility;
  const Rect rect = check_image(layer.subImage);
  record.views.push_back({from_xr(layer.pose), {}, rect, layer.subImage.imageArrayIndex, {}, {}});
  return record;
}

}  // namespace

std::vector<LayerRecord> read_layers(const XrFrameEndInfo& info) {
  std::vector<LayerRecord> records;
  for (std::uint32_t i = 0; i < info.layerCount; ++i) {
    const XrCompositionLayerBaseHeader* const layer = info.layers[i];
    if (layer->type == XR_TYPE_COMPOSITION_LAYER_PROJECTION) {
      records.push_back(read_projection(reinterpret_cast<const XrCompositionLayerProjection&>(*layer)));
    } else {
      require(layer->type == XR_TYPE_COMPOSITION_LAYER_QUAD, "layer_type", std::to_string(layer->type));
      records.push_back(read_quad(reinterpret_cast<const XrCompositionLayerQuad&>(*layer)));
    }
  }
  return records;
}

}  // namespace gearshift::xr_test
