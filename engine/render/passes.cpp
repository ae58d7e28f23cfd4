// Draws a frame, pass by pass.
#include <algorithm>
#include <stdexcept>

#include <glm/common.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/vector_relational.hpp>

#include "engine/render/pass_data.h"
#include "engine/render/renderer_state.h"

namespace gearshift::engine {

namespace {

constexpr std::uint32_t kMaxCollectedTriangles = 5000;  // [triangles] limit of flush_collected_triangles()

// The region that receives the sun's shadow: the part of the model inside the scene's shadow bounds, or the whole model
// if that part is empty.
Box shadowed_box(const Box& model, const ShadowBounds& bounds) {
  const Box box{glm::max(model.low, bounds.low), glm::min(model.high, bounds.high)};
  return glm::all(glm::lessThan(box.low, box.high)) ? box : model;
}

VkRect2D full_rect(const GpuImage& image) {
  return {{0, 0}, image.extent()};
}

// The texels of an orthographic shadow map that the bounding boxes of the items can cover.
VkRect2D texels_of(std::span<const DrawItem* const> items, const glm::mat4& clip_from_world, const GpuImage& map) {
  constexpr float kRounding = 2.0f;  // [texels]
  const glm::vec2 size(static_cast<float>(map.desc().width), static_cast<float>(map.desc().height));
  glm::vec2 low = size, high(0.0f);
  for (const DrawItem* item : items) {
    const Box box = transformed(clip_from_world, item->box);
    low = glm::min(low, (0.5f * glm::vec2(box.low) + 0.5f) * size - kRounding);
    high = glm::max(high, (0.5f * glm::vec2(box.high) + 0.5f) * size + kRounding);
  }
  const glm::ivec2 first(glm::clamp(low, glm::vec2(0.0f), size)),
      end(glm::clamp(glm::ceil(high), glm::vec2(0.0f), size));
  const glm::uvec2 extent(glm::max(end - first, glm::ivec2(0)));
  return {{first.x, first.y}, {extent.x, extent.y}};
}

void copy_depth(VkCommandBuffer commands, GpuImage& from, GpuImage& to, const VkRect2D& texels) {
  if (texels.extent.width == 0 || texels.extent.height == 0) return;
  transition(commands, from, ImageUse::copy_from);
  transition(commands, to, ImageUse::copy_to);
  const VkImageSubresourceLayers layer{.aspectMask = VK_IMAGE_ASPECT_DEPTH_BIT, .layerCount = 1};
  const VkOffset3D at{texels.offset.x, texels.offset.y, 0};
  const VkImageCopy region{.srcSubresource = layer,
                           .srcOffset = at,
                           .dstSubresource = layer,
                           .dstOffset = at,
                           .extent = {texels.extent.width, texels.extent.height, 1}};
  vkCmdCopyImage(commands, from.get(), layout_of(ImageUse::copy_from), to.get(), layout_of(ImageUse::copy_to), 1,
                 &region);
}

std::vector<glm::mat4> clips_of(std::span<const View> views, float margin) {
  std::vector<glm::mat4> clips;
  const float scale = 1.0f / (1.0f + margin);
  const glm::mat4 widen = glm::scale(glm::mat4(1.0f), glm::vec3(scale, scale, 1.0f));
  for (const View& view : views) clips.push_back(widen * clip_from_world(view));
  return clips;
}

// Returns the views of the mirrored eyes, or an empty list if either eye is behind the mirror.
std::vector<View> mirrored_views(const MirrorWindow& window, std::span<const View> views) {
  std::vector<View> mirrored;
  for (const View& view : views) {
    const std::optional<View> mirrored_view = mirror_view(window, view.eye);
    if (!mirrored_view) return {};
    mirrored.push_back(*mirrored_view);
  }
  return mirrored;
}

void check_frame(const RenderConfig& config, const GpuModel& model, const FrameScene& scene,
                 std::span<const View> views) {
  if (views.size() != static_cast<std::size_t>(config.eyes))
    throw std::invalid_argument("A frame needs one view per eye.");
  if (scene.nodes.size() != model.mesh_of_node.size())
    throw std::invalid_argument("A frame's scene needs one state per node of the model.");
  if (scene.mirror != kNone && (scene.mirror < 0 || static_cast<std::size_t>(scene.mirror) >= scene.nodes.size()))
    throw std::invalid_argument("A frame's mirror is not a node of the model.");
}

}  // namespace

std::uint64_t Renderer::State::draw(const FrameScene& scene, std::span<const View> views,
                                    std::span<Overlay* const> overlays, Finish* finish) {
  check_frame(config, model, scene, views);
  Frame frame;
  frame.scene = &scene;
  frame.views = views;
  frame.clips = clips_of(views, config.late_margin);
  frame.mirror = mirror_of(frame);
  if (frame.mirror) fit_mirror(frame.mirror->window);

  frame.commands = ring.begin();
  frame.slot_index = ring.slot();
  frame.slot = &slots[static_cast<std::size_t>(frame.slot_index)];
  timer.begin(frame.commands, frame.slot_index);
  prepare(frame);
  draw_shadow(frame);
  timer.stamp(frame.commands);
  prepare_targets(frame);
  draw_depth(frame);
  timer.stamp(frame.commands);
  draw_mirror(frame);
  timer.stamp(frame.commands);
  draw_main(frame);
  timer.stamp(frame.commands);
  draw_overlays(frame, overlays);
  timer.stamp(frame.commands);
  transition(frame.commands, picture.colour.image, ImageUse::copy_from);
  if (picture.stores_depth) transition(frame.commands, picture.stored_depth().image, ImageUse::copy_from);
  if (finish != nullptr) {
    finish->record(frame.commands, picture.colour.image, frame.slot_index);
    apply_late_views(frame, finish->late_views());
  }
  const std::uint64_t done = finish != nullptr ? ring.end(finish->wait_for, finish->then_signal) : ring.end();
  timer.end(frame.slot_index);
  return done;
}

// Returns the mirror of this frame; empty if there is none, if no eye sees its bounding box, or if either eye is behind
// it.
std::optional<FrameMirror> Renderer::State::mirror_of(const Frame& frame) const {
  const FrameScene& scene = *frame.scene;
  if (scene.mirror == kNone || config.mirror_height == 0) return std::nullopt;
  const auto node = static_cast<std::size_t>(scene.mirror);
  const int mesh = model.mesh_of_node[node];
  if (mesh == kNone || !scene.nodes[node].visible) return std::nullopt;
  const Box& box = model.meshes[static_cast<std::size_t>(mesh)].box;
  if (!Frusta(frame.clips).intersects(transformed(scene.nodes[node].world, box))) return std::nullopt;
  FrameMirror mirrored{mirror_window(scene.nodes[node].world, box), {}};
  mirrored.views = mirrored_views(mirrored.window, frame.views);
  if (mirrored.views.empty()) return std::nullopt;
  return mirrored;
}

// The recorded commands read the views from memory when they execute, so the views may still be changed until the
// submission.
void Renderer::State::apply_late_views(Frame& frame, std::span<const View> late) {
  if (late.empty()) return;
  if (late.size() != frame.views.size()) throw std::invalid_argument("A frame needs one late view per eye.");
  set_views(frame.data, late);
  frame.slot->write_pass(PassKind::depth, frame.data);
  frame.slot->write_pass(PassKind::main, frame.data);
  if (!frame.mirror) return;
  const std::vector<View> mirrored = mirrored_views(frame.mirror->window, late);
  if (mirrored.empty()) return;  // an eye moved behind the mirror: keep the earlier mirrored views
  shader::PassData data = frame.data;
  set_views(data, mirrored);
  frame.slot->write_pass(PassKind::mirror, data);
}

// Writes the buffers that the GPU reads in this frame, and lists the draws.
void Renderer::State::prepare(Frame& frame) {
  for (const View& view : frame.views) frame.eye += view.eye / static_cast<float>(frame.views.size());
  frame.slot->write_objects(gpu, *frame.scene);
  const std::vector<DeformedRange> deformed = frame.slot->write_deformed(gpu, model, frame.scene->deformed);
  frame.items = list_items(model, *frame.scene, deformed);
  for (DrawItem& item : frame.items)
    item.shows_mirror = frame.mirror.has_value() && item.node == static_cast<std::uint32_t>(frame.scene->mirror);
  frame.list = list_draws(frame.items, Frusta(frame.clips), frame.eye);
  draws = static_cast<int>(frame.list.solid.size() + frame.list.blended.size());
  set_views(frame.data, frame.views);
  set_sun(frame.data, *frame.scene);
  if (frame.mirror) set_mirror(frame.data, frame.mirror->window);
}

// Most of a cabin never moves, so static casters are drawn into a map of their own, and only when they change. Each
// frame copies that map over the texels where moving casters were drawn before, and then draws the moving casters.
void Renderer::State::draw_shadow(Frame& frame) {
  if (config.shadow_side == 0) return;
  const std::vector<glm::vec3> corners =
      visible_corners(shadowed_box(model.box, frame.scene->shadow_bounds), frame.clips);
  const ShadowFit fit = fit_shadow(corners, frame.scene->sun.towards, config.shadow_side);
  set_shadow(frame.data, fit, config.shadow_side);
  shader::PassData data = frame.data;
  data.clip_from_world[0] = fit.clip_from_world;
  frame.slot->write_pass(PassKind::shadow, data);

  const bool redraw_static = static_casters.update(fit, *frame.scene, frame.items);
  const DrawList casters = list_draws(frame.items, Frusta({&fit.clip_from_world, 1}), frame.eye);
  std::vector<const DrawItem*> static_items, moving;
  for (const DrawItem* item : casters.solid)
    (static_casters.is_static(item->node) ? static_items : moving).push_back(item);
  if (redraw_static) {
    dirty_shadow_texels = full_rect(shadow.depth);
    discard_content(shadow.static_depth);
    transition(frame.commands, shadow.static_depth, ImageUse::depth_target);
    draw_casters(frame, shadow.static_view.get(), VK_ATTACHMENT_LOAD_OP_CLEAR, static_items);
  }
  copy_depth(frame.commands, shadow.static_depth, shadow.depth, dirty_shadow_texels);
  dirty_shadow_texels = texels_of(moving, fit.clip_from_world, shadow.depth);
  if (!moving.empty()) {
    transition(frame.commands, shadow.depth, ImageUse::depth_target);
    draw_casters(frame, shadow.view.get(), VK_ATTACHMENT_LOAD_OP_LOAD, moving);
  }
  transition(frame.commands, shadow.depth, ImageUse::sampled);
}

void Renderer::State::draw_casters(const Frame& frame, VkImageView view, VkAttachmentLoadOp load,
                                   std::span<const DrawItem* const> casters) {
  const VkExtent2D extent = shadow.depth.extent();
  const Attachment depth{.view = view, .load = load};
  begin_rendering(frame.commands, extent, 1, nullptr, &depth);
  const VkRect2D inside{{kShadowMargin, kShadowMargin},
                        {extent.width - 2 * kShadowMargin, extent.height - 2 * kShadowMargin}};
  vkCmdSetScissor(frame.commands, 0, 1, &inside);
  record(frame, PassKind::shadow, casters, {});
  vkCmdEndRendering(frame.commands);
}

// Transitions all targets of the depth, mirror and main passes before the first of these passes: a barrier between two
// passes would make a software driver wait for the earlier pass.
void Renderer::State::prepare_targets(const Frame& frame) {
  const auto prepare_target = [&](GpuImage& image, ImageUse use) {
    discard_content(image);
    transition(frame.commands, image, use);
  };
  prepare_target(picture.draw_target().image, ImageUse::colour_target);
  prepare_target(picture.depth.image, ImageUse::depth_target);
  if (picture.stores_depth && picture.multisampled)
    prepare_target(picture.resolved_depth.image, ImageUse::depth_resolved);
  if (!frame.mirror) return;
  prepare_target(mirror.colour.image, ImageUse::colour_target);
  prepare_target(mirror.depth.image, ImageUse::depth_target);
}

// Depth prepass, so that each pixel is shaded once. Skipped with multisampling, because there the additional pass over
// the triangles costs a software driver more time than it saves.
void Renderer::State::draw_depth(Frame& frame) {
  if (picture.multisampled) return;
  frame.slot->write_pass(PassKind::depth, frame.data);
  for (const EyeGroup eyes : eye_groups()) {
    const Attachment depth{.view = view_of(picture.depth, eyes)};
    begin_rendering(frame.commands, picture.depth.image.extent(), eyes.count, nullptr, &depth);
    record(frame, PassKind::depth, frame.list.solid, eyes);
    vkCmdEndRendering(frame.commands);
  }
}

void Renderer::State::draw_mirror(Frame& frame) {
  if (!frame.mirror) return;
  shader::PassData data = frame.data;
  set_views(data, frame.mirror->views);
  frame.slot->write_pass(PassKind::mirror, data);
  std::vector<DrawItem> others = frame.items;  // the mirror does not reflect itself
  std::erase_if(others,
                [&](const DrawItem& item) { return item.node == static_cast<std::uint32_t>(frame.scene->mirror); });
  const DrawList list =
      list_draws(others, Frusta(clips_of(frame.mirror->views, config.late_margin)), frame.mirror->views[0].eye);
  draw_eyes(frame, PassKind::mirror, mirror.colour, mirror.depth, list);
}

void Renderer::State::draw_main(Frame& frame) {
  frame.slot->write_pass(PassKind::main, frame.data);
  if (frame.mirror) transition(frame.commands, mirror.colour.image, ImageUse::sampled);
  if (!picture.multisampled) transition(frame.commands, picture.depth.image, ImageUse::depth_target);
  draw_eyes(frame, PassKind::main, picture.draw_target(), picture.depth, frame.list);
  if (picture.multisampled) resolve(frame.commands);
}

void Renderer::State::resolve(VkCommandBuffer commands) {
  GpuImage& from = picture.samples.image;
  GpuImage& to = picture.colour.image;
  transition(commands, from, ImageUse::copy_from);
  discard_content(to);
  transition(commands, to, ImageUse::copy_to);
  const VkImageSubresourceLayers layers{.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .layerCount = to.desc().layers};
  const VkImageResolve region{
      .srcSubresource = layers, .dstSubresource = layers, .extent = {to.desc().width, to.desc().height, 1}};
  expect(from, ImageUse::copy_from);
  expect(to, ImageUse::copy_to);
  vkCmdResolveImage(commands, from.get(), layout_of(ImageUse::copy_from), to.get(), layout_of(ImageUse::copy_to), 1,
                    &region);
}

void Renderer::State::draw_overlays(const Frame& frame, std::span<Overlay* const> overlays) {
  if (overlays.empty()) return;
  GpuImage& to = picture.colour.image;
  for (std::size_t eye = 0; eye < frame.views.size(); ++eye) {
    transition(frame.commands, to, ImageUse::colour_target);
    const Attachment colour{.view = picture.overlay[eye].get(), .load = VK_ATTACHMENT_LOAD_OP_LOAD};
    begin_rendering(frame.commands, to.extent(), 1, &colour, nullptr);
    for (Overlay* overlay : overlays) overlay->draw(frame.commands, to.extent(), frame.slot_index);
    vkCmdEndRendering(frame.commands);
  }
}

void Renderer::State::store_depth(Attachment& depth, EyeGroup eyes) const {
  if (picture.multisampled)
    depth.resolved = view_of(picture.resolved_depth, eyes);
  else
    depth.store = VK_ATTACHMENT_STORE_OP_STORE;
}

VkImageView Renderer::State::view_of(const EyeImage& image, EyeGroup eyes) const {
  return layered ? image.all.get() : image.one[eyes.first].get();
}

// Draws solid items, sky and blended items: for all eyes at once, or for each eye into its layer.
void Renderer::State::draw_eyes(const Frame& frame, PassKind pass, EyeImage& colour, EyeImage& depth,
                                const DrawList& list) {
  for (const EyeGroup eyes : eye_groups()) {
    const Attachment colour_attachment{.view = view_of(colour, eyes)};
    Attachment depth_attachment{.view = view_of(depth, eyes), .store = VK_ATTACHMENT_STORE_OP_DONT_CARE};
    // draw_depth() has already filled the depth image.
    if (pass == PassKind::main && !picture.multisampled) depth_attachment.load = VK_ATTACHMENT_LOAD_OP_LOAD;
    if (pass == PassKind::main && picture.stores_depth) store_depth(depth_attachment, eyes);
    begin_rendering(frame.commands, colour.image.extent(), eyes.count, &colour_attachment, &depth_attachment);
    record(frame, pass, list.solid, eyes);
    const VkDescriptorSet set = frame.slot->set(pass);
    vkCmdBindPipeline(frame.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines->sky(pass));
    vkCmdSetCullMode(frame.commands, VK_CULL_MODE_NONE);
    vkCmdSetFrontFace(frame.commands, VK_FRONT_FACE_COUNTER_CLOCKWISE);
    vkCmdBindDescriptorSets(frame.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layouts.pipeline.get(), 0, 1, &set, 0,
                            nullptr);
    vkCmdDraw(frame.commands, 3, eyes.count, 0, eyes.first);
    record(frame, pass, list.blended, eyes);
    vkCmdEndRendering(frame.commands);
  }
}

void Renderer::State::record(const Frame& frame, PassKind pass, std::span<const DrawItem* const> items, EyeGroup eyes) {
  if (items.empty()) return;
  const VkDescriptorSet set = frame.slot->set(pass);
  vkCmdBindDescriptorSets(frame.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layouts.pipeline.get(), 0, 1, &set, 0,
                          nullptr);
  vkCmdBindIndexBuffer(frame.commands, model.indices.get(), 0, VK_INDEX_TYPE_UINT32);
  const DrawItem* previous = nullptr;
  for (const DrawItem* item : items) {
    bind_item(frame, pass, *item, previous);
    vkCmdDrawIndexed(frame.commands, item->part->index_count, eyes.count, item->part->first_index, item->vertex_offset,
                     eyes.first);
    flush_collected_triangles(frame, item->part->index_count / 3 * eyes.count);
    previous = item;
  }
}

// A software driver collects the triangles of a pass on one thread, and starts shading only when its buffer is full.
// Writing a timestamp makes the driver start at once.
void Renderer::State::flush_collected_triangles(const Frame& frame, std::uint32_t triangles) {
  if (!gpu.traits().is_cpu) return;
  collected_triangles += triangles;
  if (collected_triangles < kMaxCollectedTriangles) return;
  timer.stamp_to_flush(frame.commands);
  collected_triangles = 0;
}

// Binds only the state that differs from that of the previous item.
void Renderer::State::bind_item(const Frame& frame, PassKind pass, const DrawItem& item, const DrawItem* previous) {
  const FeatureChoice choice{config.shadow_side != 0, config.normal_maps};
  const std::uint32_t features = features_in(pass, item, choice);
  if (previous == nullptr || features != features_in(pass, *previous, choice))
    vkCmdBindPipeline(frame.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines->mesh(pass, features));
  if (previous == nullptr || item.material != previous->material)
    vkCmdBindDescriptorSets(frame.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layouts.pipeline.get(), 1, 1,
                            &item.material->set, 0, nullptr);
  if (previous == nullptr || item.deformed != previous->deformed) {
    const VkBuffer vertices = item.deformed ? frame.slot->deformed() : model.vertices.get();
    const VkDeviceSize offset = 0;
    vkCmdBindVertexBuffers(frame.commands, 0, 1, &vertices, &offset);
  }
  // Clip space has y down, so glTF's counter-clockwise triangles are still counter-clockwise in the framebuffer. For
  // shadows, both faces of a thin shell are drawn.
  const bool both = item.material->double_sided || pass == PassKind::shadow;
  vkCmdSetCullMode(frame.commands, both ? VK_CULL_MODE_NONE : VK_CULL_MODE_BACK_BIT);
  vkCmdSetFrontFace(frame.commands, item.mirrored ? VK_FRONT_FACE_CLOCKWISE : VK_FRONT_FACE_COUNTER_CLOCKWISE);
  const shader::DrawData data{item.node, item.emission, item.opacity, item.material->double_sided ? 1.0f : 0.0f};
  vkCmdPushConstants(frame.commands, layouts.pipeline.get(), VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT,
                     0, sizeof data, &data);
}

}  // namespace gearshift::engine
