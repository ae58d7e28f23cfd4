#include "engine/render/renderer.h"

#include <algorithm>
#include <cmath>
#include <future>
#include <stdexcept>
#include <utility>

#include "engine/light/enclosure.h"
#include "engine/render/renderer_state.h"
#include "engine/render/samplers.h"

namespace gearshift::engine {

namespace {

void check_config(const Gpu& gpu, const RenderConfig& config) {
  const auto within = [](int value, int low, int high) { return value >= low && value <= high; };
  if (!within(config.width, 1, 16384) || !within(config.height, 1, 16384))
    throw std::invalid_argument("A picture must be 1 to 16384 pixels wide and high.");
  if (!within(config.eyes, 1, 2)) throw std::invalid_argument("A picture must have one or two eyes.");
  if (config.samples != 1 && config.samples != 4) throw std::invalid_argument("A pixel must have 1 or 4 samples.");
  if (config.shadow_side != 0 && !within(config.shadow_side, 16, 8192))
    throw std::invalid_argument("A shadow map must have 16 to 8192 texels per side; 0 means no shadows.");
  if (!within(config.mirror_height, 0, 2048)) throw std::invalid_argument("A mirror must be 0 to 2048 pixels high.");
  if (!(config.late_margin >= 0.0f && config.late_margin <= 1.0f))
    throw std::invalid_argument("The late-view margin must be between 0 and 1.");
  if (config.samples == 4 && !gpu.traits().four_samples)
    throw GpuError(gpu.traits().name + " does not support 4 samples per pixel. Use 1 sample.");
  if (config.eyes == 2 && config.eye_passes == EyePasses::layered && !gpu.traits().layered_vertex)
    throw GpuError(gpu.traits().name + " cannot draw both eyes in one pass.");
}

SetPool pass_sets(const Gpu& gpu) {
  constexpr std::uint32_t kSets = kPassKinds * kFramesInFlight;
  constexpr std::array kSizes{VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, kSets},
                              VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kSets},
                              VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 6 * kSets}};
  return {gpu, kSets, kSizes};
}

LightMaps day_light() {
  const Sun sun;
  const Radiance open = day_sky(sun.towards);
  return light_maps(open, indoor_radiance(car_cabin(), open, sun.towards, sun.irradiance));
}

VkSampleCountFlagBits sample_count(const RenderConfig& config) {
  return config.samples == 4 ? VK_SAMPLE_COUNT_4_BIT : VK_SAMPLE_COUNT_1_BIT;
}

VkExtent2D mirror_extent(const MirrorWindow& window, int height) {
  const float aspect = std::clamp(window.aspect(), 0.1f, 10.0f);
  return {std::max(1u, static_cast<std::uint32_t>(std::lround(aspect * static_cast<float>(height)))),
          static_cast<std::uint32_t>(height)};
}

}  // namespace

Renderer::State::State(Gpu& device, const RenderConfig& wanted)
    : gpu(device),
      config(wanted),
      ring(device),
      timer(device),
      layouts(device),
      clamped(picture_sampler(device)),
      by_roughness(reflection_sampler(device)),
      shadow_compare(shadow_sampler(device)),
      sets(pass_sets(device)) {
  check_config(gpu, config);
  auto maps = std::async(std::launch::async, day_light);
  upload_brdf(gpu, bake_brdf(), light);
  for (FrameSlot& slot : slots) {
    std::array<VkDescriptorSet, kPassKinds> of_slot{};
    for (VkDescriptorSet& set : of_slot) {
      set = sets.make(layouts.pass.get());
      bind_texture(gpu, set, shader::kBindBrdf, light.brdf_view.get(), clamped.get());
    }
    slot = FrameSlot(gpu, of_slot);
  }
  mirror_placeholder = MirrorTarget(gpu, {1, 1}, 1);
  run_once(gpu,
           [&](VkCommandBuffer commands) { transition(commands, mirror_placeholder.colour.image, ImageUse::sampled); });
  make_picture();
  make_shadow();
  drop_mirror();
  model = upload_model(gpu, Model{}, layouts.material.get());
  set_light(maps.get());
}

// Creates the picture's images for the configuration. Must not be called while a frame is in flight.
void Renderer::State::make_picture() {
  const auto eyes = static_cast<std::uint32_t>(config.eyes);
  const VkExtent2D extent{static_cast<std::uint32_t>(config.width), static_cast<std::uint32_t>(config.height)};
  layered = config.eyes == 2 && config.eye_passes != EyePasses::one_by_one && gpu.traits().layered_vertex;
  picture = PictureTarget(gpu, extent, eyes, sample_count(config), config.keep_depth);
}

void Renderer::State::make_shadow() {
  static_casters.reset();
  shadow = ShadowTarget(gpu, static_cast<std::uint32_t>(std::max(1, config.shadow_side)));
  run_once(gpu, [&](VkCommandBuffer commands) { transition(commands, shadow.depth, ImageUse::sampled); });
  for (const FrameSlot& slot : slots) {
    for (const PassKind pass : kPasses)
      bind_texture(gpu, slot.set(pass), shader::kBindShadow, shadow.view.get(), shadow_compare.get());
  }
}

// Frees the mirror's images; fit_mirror() creates them again when a mirror is visible.
void Renderer::State::drop_mirror() {
  mirror = MirrorTarget();
  bind_mirror();
}

// Recreates only what the change affects, so that dragging a window's border compiles no pipeline.
void Renderer::State::resize(const RenderConfig& wanted) {
  const RenderConfig previous = std::exchange(config, wanted);
  const bool was_layered = layered;
  make_picture();
  if (config.samples != previous.samples || layered != was_layered) make_pipelines();
  if (config.shadow_side != previous.shadow_side) make_shadow();
  if (config.eyes != previous.eyes || config.mirror_height != previous.mirror_height) drop_mirror();
}

void Renderer::State::make_pipelines() {
  pipelines = std::make_unique<Pipelines>(gpu, layouts, sample_count(config), layered, light.irradiance,
                                          light.irradiance_indoors);
}

void Renderer::State::set_light(const LightMaps& maps) {
  upload_light(gpu, maps, light);
  make_pipelines();
  for (const FrameSlot& slot : slots) {
    for (const PassKind pass : kPasses) {
      bind_texture(gpu, slot.set(pass), shader::kBindReflections, light.reflections_view.get(), by_roughness.get());
      bind_texture(gpu, slot.set(pass), shader::kBindIndoors, light.indoors_view.get(), by_roughness.get());
      bind_texture(gpu, slot.set(pass), shader::kBindSky, light.sky_view.get(), clamped.get());
    }
  }
}

void Renderer::State::set_model(const Model& content) {
  model = upload_model(gpu, content, layouts.material.get());
  static_casters.reset();
}

// Creates the mirror's images, with the aspect ratio of the mirror, when a mirror is first visible or its shape has
// changed.
void Renderer::State::fit_mirror(const MirrorWindow& window) {
  const VkExtent2D extent = mirror_extent(window, config.mirror_height), current = mirror.colour.image.extent();
  if (mirror.colour.all && extent.width == current.width && extent.height == current.height) return;
  ring.wait();
  mirror = MirrorTarget(gpu, extent, static_cast<std::uint32_t>(config.eyes));
  run_once(gpu, [&](VkCommandBuffer commands) { transition(commands, mirror.colour.image, ImageUse::sampled); });
  bind_mirror();
}

void Renderer::State::bind_mirror() {
  const VkImageView placeholder = mirror_placeholder.colour.all.get(),
                    current = mirror.colour.all ? mirror.colour.all.get() : placeholder;
  for (const FrameSlot& slot : slots) {
    for (const PassKind pass : kPasses)
      bind_texture(gpu, slot.set(pass), shader::kBindMirror, pass == PassKind::main ? current : placeholder,
                   clamped.get());
  }
}

std::vector<EyeGroup> Renderer::State::eye_groups() const {
  const auto eyes = static_cast<std::uint32_t>(config.eyes);
  if (layered || eyes == 1) return {{0, eyes}};
  return {{0, 1}, {1, 1}};
}

Renderer::Renderer(Gpu& gpu, const RenderConfig& config) : state_(std::make_unique<State>(gpu, config)) {}

Renderer::~Renderer() = default;

void Renderer::set_model(const Model& model) {
  state_->ring.wait();
  state_->set_model(model);
}

void Renderer::set_environment(const Radiance& open, const Radiance& indoors) {
  const LightMaps maps = light_maps(open, indoors ? indoors : open);
  state_->ring.wait();
  state_->set_light(maps);
}

void Renderer::resize(const RenderConfig& config) {
  check_config(state_->gpu, config);
  state_->ring.wait();
  state_->resize(config);
}

const RenderConfig& Renderer::config() const noexcept {
  return state_->config;
}

std::uint64_t Renderer::draw(const FrameScene& scene, std::span<const View> views, std::span<Overlay* const> overlays) {
  return state_->draw(scene, views, overlays, nullptr);
}

std::uint64_t Renderer::draw(const FrameScene& scene, std::span<const View> views, std::span<Overlay* const> overlays,
                             Finish& finish) {
  return state_->draw(scene, views, overlays, &finish);
}

GpuImage& Renderer::colour() noexcept {
  return state_->picture.colour.image;
}

GpuImage& Renderer::depth() noexcept {
  return state_->picture.stored_depth().image;
}

Image Renderer::read_eye(int eye) {
  state_->ring.wait();
  return read_back(state_->gpu, state_->picture.colour.image, static_cast<std::uint32_t>(eye));
}

const PassTimes& Renderer::times() const noexcept {
  return state_->timer.times();
}

int Renderer::draws() const noexcept {
  return state_->draws;
}

bool Renderer::layered() const noexcept {
  return state_->layered;
}

}  // namespace gearshift::engine
