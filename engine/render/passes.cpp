// A frame, pass by pass.
#include <algorithm>
#include <stdexcept>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/render/pass_data.h"
#include "engine/render/renderer_state.h"

namespace gearshift {

namespace {

// About the eye, in steps: a head that moves a little leaves the kept shadow as it is.
constexpr float kSphereSteps = 8.0f;

Sphere shadow_sphere(const Box& scene, glm::vec3 eye, float reach) {
  const Sphere whole{scene.centre(), 0.5f * glm::distance(scene.low, scene.high)};
  if (whole.radius <= reach) return {whole.centre, std::max(whole.radius, 1e-3f)};
  const float step = reach / kSphereSteps;
  return {glm::round(eye / step) * step, reach};
}

void copy_depth(VkCommandBuffer commands, GpuImage& from, GpuImage& to) {
  transition(commands, from, ImageUse::copy_from);
  forget(to);
  transition(commands, to, ImageUse::copy_to);
  const VkImageSubresourceLayers layer{.aspectMask = VK_IMAGE_ASPECT_DEPTH_BIT, .layerCount = 1};
  const VkImageCopy region{
      .srcSubresource = layer, .dstSubresource = layer, .extent = {to.desc().width, to.desc().height, 1}};
  vkCmdCopyImage(commands, from.get(), layout_of(ImageUse::copy_from), to.get(), layout_of(ImageUse::copy_to), 1,
                 &region);
}

std::vector<glm::mat4> clips_of(std::span<const View> views) {
  std::vector<glm::mat4> clips;
  for (const View& view : views) clips.push_back(clip_from_world(view));
  return clips;
}

void check_frame(const RenderConfig& config, const GpuModel& model, const FrameScene& scene,
                 std::span<const View> views) {
  if (views.size() != static_cast<std::size_t>(config.eyes))
    throw std::invalid_argument("A frame needs one view an eye.");
  if (scene.nodes.size() != model.mesh_of_node.size())
    throw std::invalid_argument("A frame's scene needs one state a node of the model.");
  if (scene.mirror != kNone && (scene.mirror < 0 || static_cast<std::size_t>(scene.mirror) >= scene.nodes.size()))
    throw std::invalid_argument("A frame's mirror is no node of the model.");
}

}  // namespace

std::uint64_t Renderer::State::draw(const FrameScene& scene, std::span<const View> views,
                                    std::span<Overlay* const> overlays, Finish* finish) {
  check_frame(config, model, scene, views);
  Frame frame;
  frame.scene = &scene;
  frame.views = views;
  frame.mirror = mirror_of(scene, views);
  if (frame.mirror) fit_mirror(frame.mirror->window);

  frame.commands = ring.begin();
  frame.slot_index = ring.slot();
  frame.slot = &slots[static_cast<std::size_t>(frame.slot_index)];
  timer.begin(frame.commands, frame.slot_index);
  prepare(frame);
  draw_shadow(frame);
  timer.stamp(frame.commands);
  draw_mirror(frame);
  timer.stamp(frame.commands);
  draw_main(frame);
  timer.stamp(frame.commands);
  draw_overlays(frame, overlays);
  timer.stamp(frame.commands);
  transition(frame.commands, picture.colour.image, ImageUse::copy_from);
  if (finish == nullptr) return ring.end();
  finish->record(frame.commands, picture.colour.image);
  return ring.end(finish->wait_for, finish->then_signal);
}

// Empty where there is none, where no eye sees its box, or where some eye is behind it.
std::optional<MirrorOfFrame> Renderer::State::mirror_of(const FrameScene& scene, std::span<const View> views) const {
  if (scene.mirror == kNone || config.mirror_height == 0) return std::nullopt;
  const auto node = static_cast<std::size_t>(scene.mirror);
  const int mesh = model.mesh_of_node[node];
  if (mesh == kNone || !scene.nodes[node].visible) return std::nullopt;
  const Box& box = model.meshes[static_cast<std::size_t>(mesh)].box;
  if (!Frusta(clips_of(views)).see(moved(scene.nodes[node].world, box))) return std::nullopt;
  MirrorOfFrame mirrored{mirror_window(scene.nodes[node].world, box), {}};
  for (const View& view : views) {
    const std::optional<View> seen = mirror_view(mirrored.window, view.eye);
    if (!seen) return std::nullopt;
    mirrored.views.push_back(*seen);
  }
  return mirrored;
}

// Writes what the GPU reads of this frame, and lists what there is to draw.
void Renderer::State::prepare(Frame& frame) {
  for (const View& view : frame.views) frame.eye += view.eye / static_cast<float>(frame.views.size());
  frame.slot->write_objects(gpu, *frame.scene);
  const std::vector<DeformedPlace> deformed = frame.slot->write_deformed(gpu, model, frame.scene->deformed);
  frame.items = list_items(model, *frame.scene, deformed);
  set_sun(frame.data, *frame.scene);
  if (frame.mirror) set_mirror(frame.data, frame.mirror->window);
}

// The casters that stand still are drawn when they change, and copied: most of a cabin never moves.
void Renderer::State::draw_shadow(Frame& frame) {
  if (config.shadow_side == 0) return;
  const Sphere sphere = shadow_sphere(model.box, frame.eye, frame.scene->shadow_reach);
  const ShadowFit fit = fit_shadow(sphere, frame.scene->sun.towards, config.shadow_side);
  set_shadow(frame.data, fit);
  shader::PassData data = frame.data;
  data.clip_from_world[0] = fit.clip_from_world;
  frame.slot->write_pass(PassKind::shadow, data);

  const bool anew = still_casters.changed(fit, *frame.scene, frame.items);
  const DrawList seen = list_draws(frame.items, Frusta({&fit.clip_from_world, 1}), frame.eye);
  std::vector<const DrawItem*> still, moving;
  for (const DrawItem* item : seen.solid) (still_casters.stands_still(item->node) ? still : moving).push_back(item);
  if (!anew && shadow_is_still && moving.empty()) return;
  if (anew) {
    forget(shadow.still);
    transition(frame.commands, shadow.still, ImageUse::depth_target);
    draw_casters(frame, shadow.still_view.get(), VK_ATTACHMENT_LOAD_OP_CLEAR, still);
  }
  copy_depth(frame.commands, shadow.still, shadow.depth);
  if (!moving.empty()) {
    transition(frame.commands, shadow.depth, ImageUse::depth_target);
    draw_casters(frame, shadow.view.get(), VK_ATTACHMENT_LOAD_OP_LOAD, moving);
  }
  transition(frame.commands, shadow.depth, ImageUse::sampled);
  shadow_is_still = moving.empty();
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

void Renderer::State::draw_mirror(Frame& frame) {
  if (!frame.mirror) return;
  shader::PassData data = frame.data;
  set_views(data, frame.mirror->views);
  frame.slot->write_pass(PassKind::mirror, data);
  std::vector<DrawItem> others = frame.items;  // a mirror does not see itself
  std::erase_if(others,
                [&](const DrawItem& item) { return item.node == static_cast<std::uint32_t>(frame.scene->mirror); });
  const DrawList list = list_draws(others, Frusta(clips_of(frame.mirror->views)), frame.mirror->views[0].eye);
  draw_eyes(frame, PassKind::mirror, mirror.colour, mirror.depth, list);
  transition(frame.commands, mirror.colour.image, ImageUse::sampled);
}

void Renderer::State::draw_main(Frame& frame) {
  set_views(frame.data, frame.views);
  frame.slot->write_pass(PassKind::main, frame.data);
  frame.slot->write_pass(PassKind::depth, frame.data);
  for (DrawItem& item : frame.items)
    item.shows_mirror = frame.mirror.has_value() && item.node == static_cast<std::uint32_t>(frame.scene->mirror);
  const DrawList list = list_draws(frame.items, Frusta(clips_of(frame.views)), frame.eye);
  draws = static_cast<int>(list.solid.size() + list.blended.size());
  draw_eyes(frame, PassKind::main, picture.drawn(), picture.depth, list);
  if (picture.multisampled) resolve(frame.commands);
}

void Renderer::State::resolve(VkCommandBuffer commands) {
  GpuImage& from = picture.samples.image;
  GpuImage& to = picture.colour.image;
  transition(commands, from, ImageUse::copy_from);
  forget(to);
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

// Solid, sky, blended: for all eyes at once, or for each into its layer.
void Renderer::State::draw_eyes(const Frame& frame, PassKind pass, EyeImage& colour, EyeImage& depth,
                                const DrawList& list) {
  for (GpuImage* image : {&colour.image, &depth.image}) forget(*image);
  transition(frame.commands, colour.image, ImageUse::colour_target);
  transition(frame.commands, depth.image, ImageUse::depth_target);
  for (const EyeGroup eyes : eye_groups()) {
    const auto view = [&](const EyeImage& image) { return layered ? image.all.get() : image.one[eyes.first].get(); };
    const Attachment drawn{.view = view(colour)};
    Attachment deep{.view = view(depth)};
    if (pass == PassKind::main && !picture.multisampled) {
      draw_depth(frame, depth, list.solid, eyes, deep);
      deep.load = VK_ATTACHMENT_LOAD_OP_LOAD;
    }
    deep.store = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    begin_rendering(frame.commands, colour.image.extent(), eyes.count, &drawn, &deep);
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

// Depth first, so that each pixel is shaded once. At four samples a software driver loses more by the second pass over
// the triangles than it saves.
void Renderer::State::draw_depth(const Frame& frame, EyeImage& depth, std::span<const DrawItem* const> solid,
                                 EyeGroup eyes, const Attachment& target) {
  begin_rendering(frame.commands, depth.image.extent(), eyes.count, nullptr, &target);
  record(frame, PassKind::depth, solid, eyes);
  vkCmdEndRendering(frame.commands);
  transition(frame.commands, depth.image, ImageUse::depth_target);
}

void Renderer::State::record(const Frame& frame, PassKind pass, std::span<const DrawItem* const> items, EyeGroup eyes) {
  if (items.empty()) return;
  const VkDescriptorSet set = frame.slot->set(pass);
  vkCmdBindDescriptorSets(frame.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layouts.pipeline.get(), 0, 1, &set, 0,
                          nullptr);
  vkCmdBindIndexBuffer(frame.commands, model.indices.get(), 0, VK_INDEX_TYPE_UINT32);
  const DrawItem* before = nullptr;
  for (const DrawItem* item : items) {
    bind_item(frame, pass, *item, before);
    vkCmdDrawIndexed(frame.commands, item->part->index_count, eyes.count, item->part->first_index, item->vertex_offset,
                     eyes.first);
    before = item;
  }
}

// What differs from the item drawn before.
void Renderer::State::bind_item(const Frame& frame, PassKind pass, const DrawItem& item, const DrawItem* before) {
  const FeatureChoice choice{config.shadow_side != 0, config.normal_maps};
  const std::uint32_t features = features_in(pass, item, choice);
  if (before == nullptr || features != features_in(pass, *before, choice))
    vkCmdBindPipeline(frame.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines->mesh(pass, features));
  if (before == nullptr || item.material != before->material)
    vkCmdBindDescriptorSets(frame.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layouts.pipeline.get(), 1, 1,
                            &item.material->set, 0, nullptr);
  if (before == nullptr || item.deformed != before->deformed) {
    const VkBuffer vertices = item.deformed ? frame.slot->deformed() : model.vertices.get();
    const VkDeviceSize offset = 0;
    vkCmdBindVertexBuffers(frame.commands, 0, 1, &vertices, &offset);
  }
  // The clip space's y runs down: what glTF winds counter-clockwise still is, seen in the framebuffer. A thin shell
  // shadows with both its faces.
  const bool both = item.material->double_sided || pass == PassKind::shadow;
  vkCmdSetCullMode(frame.commands, both ? VK_CULL_MODE_NONE : VK_CULL_MODE_BACK_BIT);
  vkCmdSetFrontFace(frame.commands, item.mirrored ? VK_FRONT_FACE_CLOCKWISE : VK_FRONT_FACE_COUNTER_CLOCKWISE);
  const shader::DrawData data{item.node, item.emission, item.opacity, 0.0f};
  vkCmdPushConstants(frame.commands, layouts.pipeline.get(), VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT,
                     0, sizeof data, &data);
}

}  // namespace gearshift
