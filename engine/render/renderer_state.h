// State of a renderer: renderer.cpp sets the state up, passes.cpp draws with it.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "engine/gpu/commands.h"
#include "engine/render/draw_list.h"
#include "engine/render/frame_slot.h"
#include "engine/render/light_textures.h"
#include "engine/render/mirror_view.h"
#include "engine/render/pass_timer.h"
#include "engine/render/renderer.h"
#include "engine/render/static_casters.h"
#include "engine/render/targets.h"

namespace gearshift::engine {

// The car's mirror in this frame: its rectangle in the world (see MirrorWindow), and the eyes' views reflected in it.
struct FrameMirror {
  MirrorWindow window;
  std::vector<View> views;
};

// Data of one frame while it is recorded.
struct Frame {
  VkCommandBuffer commands = VK_NULL_HANDLE;
  FrameSlot* slot = nullptr;
  int slot_index = 0;
  const FrameScene* scene = nullptr;
  std::span<const View> views;
  std::vector<glm::mat4> clips;  // clip matrices of the views, widened by late_margin, for culling
  std::optional<FrameMirror> mirror;
  glm::vec3 eye{0.0f};  // midway between the eyes
  std::vector<DrawItem> items;
  DrawList list;            // draws of the main pass
  shader::PassData data{};  // uniforms common to the passes
};

// Eyes drawn by the same commands: all eyes into the layers of an image, or a single eye into its layer.
struct EyeGroup {
  std::uint32_t first = 0, count = 1;
};

struct Renderer::State {
  State(Gpu& device, const RenderConfig& wanted);
  ~State() { gpu.wait_idle(); }  // no object may be destroyed while a frame uses it

  // defined in renderer.cpp
  void make_picture();
  void make_shadow();
  void drop_mirror();
  void make_pipelines();
  void resize(const RenderConfig& wanted);
  void set_light(const LightMaps& maps);
  void set_model(const Model& content);
  void fit_mirror(const MirrorWindow& window);
  void bind_mirror();
  std::vector<EyeGroup> eye_groups() const;

  // defined in passes.cpp
  std::uint64_t draw(const FrameScene& scene, std::span<const View> views, std::span<Overlay* const> overlays,
                     Finish* finish);
  std::optional<FrameMirror> mirror_of(const Frame& frame) const;
  void prepare(Frame& frame);
  void draw_shadow(Frame& frame);
  void draw_casters(const Frame& frame, VkImageView view, VkAttachmentLoadOp load,
                    std::span<const DrawItem* const> casters);
  void prepare_targets(const Frame& frame);
  void draw_depth(Frame& frame);
  void draw_mirror(Frame& frame);
  void draw_main(Frame& frame);
  void resolve(VkCommandBuffer commands);
  void apply_late_views(Frame& frame, std::span<const View> late);
  void draw_overlays(const Frame& frame, std::span<Overlay* const> overlays);
  void store_depth(Attachment& depth, EyeGroup eyes) const;
  VkImageView view_of(const EyeImage& image, EyeGroup eyes) const;
  void draw_eyes(const Frame& frame, PassKind pass, EyeImage& colour, EyeImage& depth, const DrawList& list);
  void record(const Frame& frame, PassKind pass, std::span<const DrawItem* const> items, EyeGroup eyes);
  void flush_collected_triangles(const Frame& frame, std::uint32_t triangles);
  void bind_item(const Frame& frame, PassKind pass, const DrawItem& item, const DrawItem* previous);

  Gpu& gpu;
  RenderConfig config;
  FrameRing ring;
  PassTimer timer;
  RenderLayouts layouts;
  Sampler clamped, by_roughness, shadow_compare;
  SetPool sets;
  std::array<FrameSlot, kFramesInFlight> slots;
  LightTextures light;
  ShadowTarget shadow;
  StaticCasters static_casters;
  VkRect2D dirty_shadow_texels{};  // texels of the map that show moving casters
  // `mirror_placeholder`: one black texel. It is bound in place of the mirror's picture in all passes but the main
  // pass, and in the main pass until a mirror is visible.
  MirrorTarget mirror_placeholder, mirror;
  PictureTarget picture;
  std::unique_ptr<Pipelines> pipelines;
  GpuModel model;
  bool layered = false;
  int draws = 0;
  std::uint32_t collected_triangles = 0;  // [triangles] since the last flush
};

}  // namespace gearshift::engine
