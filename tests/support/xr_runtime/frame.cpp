// The frame loop: xrWaitFrame, xrBeginFrame, xrEndFrame. Checks and records the submitted layers, and reads their pixels
// through the program's Vulkan queue, which xrEndFrame may use.
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "tests/support/xr_runtime/state.h"

namespace gearshift::xr_test {
namespace {

// Checks a submitted rectangle of an image. Returns the image's pixels if `captured`, otherwise nothing.
std::vector<std::uint8_t> read_image(const XrSwapchainSubImage& image, bool captured, ViewRecord::Rect& rect) {
  const Object<XrSwapchain>& swapchain = live(image.swapchain);
  require(swapchain.released.has_value(), "image_order", "no image was released");
  require(swapchain.acquired.empty(), "image_order", "an image is still acquired: the previous one would be shown");
  const auto [offset, extent] = image.imageRect;
  const bool inside = offset.x >= 0 && offset.y >= 0 && extent.width > 0 && extent.height > 0 &&
                      offset.x + extent.width <= static_cast<int>(swapchain.info.width) &&
                      offset.y + extent.height <= static_cast<int>(swapchain.info.height) &&
                      image.imageArrayIndex < swapchain.info.arraySize;
  require(inside, "image_rect");
  rect = {offset.x, offset.y, extent.width, extent.height};
  return captured ? read_pixels(image) : std::vector<std::uint8_t>();
}

void read_picture(const XrSwapchainSubImage& image, bool captured, ViewRecord& view) {
  std::vector<std::uint8_t> pixels = read_image(image, captured, view.rect);
  if (pixels.empty()) return;
  const std::int64_t format = live(image.swapchain).info.format;
  if (format == VK_FORMAT_B8G8R8A8_SRGB || format == VK_FORMAT_B8G8R8A8_UNORM) {
    for (std::size_t i = 0; i < pixels.size(); i += 4) std::swap(pixels[i], pixels[i + 2]);
  }
  view.picture = {view.rect.width, view.rect.height, std::move(pixels)};
}

Fov read_fov(const XrFovf& fov) {
  constexpr float kMaxFovAngle = std::numbers::pi_v<float> / 2.0f;
  for (const float angle : {fov.angleLeft, fov.angleRight, fov.angleUp, fov.angleDown})
    require(std::isfinite(angle) && std::abs(angle) < kMaxFovAngle, "fov");
  require(fov.angleLeft != fov.angleRight && fov.angleUp != fov.angleDown, "fov", "spans nothing");
  return {fov.angleLeft, fov.angleRight, fov.angleUp, fov.angleDown};
}

DepthRecord read_depth(const XrCompositionLayerProjectionView& view, bool captured) {
  const auto* const depth =
      static_cast<const XrCompositionLayerDepthInfoKHR*>(find_chained(&view, XR_TYPE_COMPOSITION_LAYER_DEPTH_INFO_KHR));
  if (depth == nullptr) return {};
  DepthRecord record{true, depth->minDepth, depth->maxDepth, depth->nearZ, depth->farZ, {}};
  require(record.min_depth >= 0.0f && record.min_depth < record.max_depth && record.max_depth <= 1.0f, "depth_info");
  require(record.near_z >= 0.0f && record.far_z >= 0.0f && record.near_z != record.far_z, "depth_info", "nearZ, farZ");
  require(is_depth(live(depth->subImage.swapchain).info.format), "depth_info", "the format is a colour's");
  ViewRecord::Rect rect;
  const std::vector<std::uint8_t> bytes = read_image(depth->subImage, captured, rect);
  record.values.resize(bytes.size() / sizeof(float));
  if (!bytes.empty()) std::memcpy(record.values.data(), bytes.data(), bytes.size());
  return record;
}

LayerRecord read_projection(const XrCompositionLayerProjection& layer, bool captured) {
  require(layer.viewCount == 2, "layers", std::to_string(layer.viewCount) + " views");
  LayerRecord record{.type = layer.type, .flags = layer.layerFlags};
  for (std::uint32_t i = 0; i < layer.viewCount; ++i) {
    const XrCompositionLayerProjectionView& view = layer.views[i];
    require_unit_pose(view.pose, "view");
    ViewRecord& to = record.views.emplace_back(ViewRecord{from_xr(view.pose), read_fov(view.fov)});
    read_picture(view.subImage, captured, to);
    to.depth = read_depth(view, captured);
  }
  return record;
}

LayerRecord read_quad(const XrCompositionLayerQuad& layer, bool captured) {
  require_unit_pose(layer.pose, "quad");
  LayerRecord record{layer.type, layer.layerFlags, {}, layer.size.width, layer.size.height};
  read_picture(layer.subImage, captured, record.views.emplace_back(ViewRecord{from_xr(layer.pose)}));
  return record;
}

std::vector<LayerRecord> read_layers(const XrFrameEndInfo& info, bool captured) {
  require(info.layerCount <= XR_MIN_COMPOSITION_LAYERS_SUPPORTED, "layers", std::to_string(info.layerCount));
  std::vector<LayerRecord> records;
  for (std::uint32_t i = 0; i < info.layerCount; ++i) {
    const XrCompositionLayerBaseHeader* const layer = info.layers[i];
    if (layer->type == XR_TYPE_COMPOSITION_LAYER_PROJECTION) {
      records.push_back(read_projection(reinterpret_cast<const XrCompositionLayerProjection&>(*layer), captured));
    } else {
      require(layer->type == XR_TYPE_COMPOSITION_LAYER_QUAD, "layers", "type " + std::to_string(layer->type));
      records.push_back(read_quad(reinterpret_cast<const XrCompositionLayerQuad&>(*layer), captured));
    }
  }
  return records;
}

void log_frame(const FrameRecord& record) {
  std::string line = "frame " + std::to_string(record.index) + " t=" + std::to_string(record.time) +
                     (record.should_render ? " shown" : " hidden") + " layers=" + std::to_string(record.layers.size()) +
                     " locates=" + std::to_string(record.locates);
  if (record.projection() != nullptr)
    line += record.projection()->views[0].depth.is_present ? " projection+depth" : " projection";
  if (record.quad() != nullptr) line += " quad";
  log_line(line);
}

void write_pictures(const FrameRecord& record) {
  const auto write = [&](const char* what, const engine::Image& image) {
    if (out_folder() == nullptr || image.rgba.empty()) return;
    char name[64];
    std::snprintf(name, sizeof name, "frame_%06d_%s.png", static_cast<int>(record.index), what);
    engine::write_png(std::filesystem::path(out_folder()) / name, image);
  };
  if (record.projection() != nullptr) {
    write("left", record.projection()->views[0].picture);
    write("right", record.projection()->views[1].picture);
  }
  if (record.quad() != nullptr) write("quad", record.quad()->views[0].picture);
}

}  // namespace

XrResult XRAPI_CALL xr::WaitFrame(XrSession session, const XrFrameWaitInfo*, XrFrameState* state) {
  return call("xrWaitFrame", [&](State& s) {
    Object<XrSession>& object = live(session);
    require(object.running, "session_state");
    require(!object.waited, "frame_order");
    // Handle the events that are due before choosing the display time, because an event `stall` delays it.
    const bool steps = s.control.script.pacing == Pacing::stepped;
    play_timeline(s, seconds(s, steps ? display_time(s, s.next_step) : now(s)));
    live(session);  // rejects the call if an event lost the session
    advance_state(s, session);
    const XrTime time = display_time(s, next_display_period(s, object.waits > 0));
    ++object.waits;
    std::vector<FrameRecord>& frames = s.control.record.frames;
    object.waited = frames.size();
    const bool visible = object.state == XR_SESSION_STATE_VISIBLE || object.state == XR_SESSION_STATE_FOCUSED;
    const bool shown = visible && seconds(s, time) >= s.hidden_until;
    frames.push_back({.index = frames.size(), .time = seconds(s, time), .display_time = time, .should_render = shown});
    state->predictedDisplayTime = time;
    state->predictedDisplayPeriod = kPeriodNs;
    state->shouldRender = shown ? XR_TRUE : XR_FALSE;
  });
}

XrResult XRAPI_CALL xr::BeginFrame(XrSession session, const XrFrameBeginInfo*) {
  return call("xrBeginFrame", [&](State&) {
    Object<XrSession>& object = live(session);
    require(object.running, "session_state");
    require(object.waited.has_value(), "frame_order");
    const bool discarded = object.begun.has_value();
    object.begun = object.waited;
    object.waited.reset();
    return discarded ? XR_FRAME_DISCARDED : XR_SUCCESS;
  });
}

XrResult XRAPI_CALL xr::EndFrame(XrSession session, const XrFrameEndInfo* info) {
  return call("xrEndFrame", [&](State& s) {
    Object<XrSession>& object = live(session);
    require(object.running, "session_state");
    require(object.begun.has_value(), "frame_order");
    FrameRecord& record = s.control.record.frames[*object.begun];
    require(info->displayTime == record.display_time, "frame_time");
    require(info->environmentBlendMode == XR_ENVIRONMENT_BLEND_MODE_OPAQUE, "offered", "environmentBlendMode");
    const int every = s.control.script.capture_every;
    record.layers = read_layers(*info, every > 0 && record.index % static_cast<std::uint64_t>(every) == 0);
    object.begun.reset();
    log_frame(record);
    write_pictures(record);
  });
}

}  // namespace gearshift::xr_test
