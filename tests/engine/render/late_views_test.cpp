// Features for headsets: eyes that move after recording, and depth.
#include <cstring>

#include "engine/gpu/commands.h"
#include "engine/render/targets.h"
#include "tests/engine/gpu/glsl.h"
#include "tests/engine/render/render_bench.h"

using namespace gearshift::engine;
using namespace gearshift::test;
using glm::dvec3;
using glm::vec3;

namespace {

constexpr double kNear = 0.05;  // [m]

std::array<View, 2> eyes_of(const RenderConfig& config, const EyePose& head) {
  const StereoEyes eyes =
      stereo_eyes(head, symmetric_fov(1.0, static_cast<double>(config.width) / config.height), 0.064, 1.0);
  return {view_from(eyes.pose[0], eyes.fov[0], kNear), view_from(eyes.pose[1], eyes.fov[1], kNear)};
}

RenderConfig for_headset(int samples, EyePasses passes = EyePasses::automatic) {
  RenderConfig config = small_picture(160, 120);
  config.eyes = 2;
  config.samples = samples;
  config.eye_passes = passes;
  config.mirror_height = 32;
  config.keep_depth = true;
  config.late_margin = 0.1f;
  return config;
}

// A row of cubes from left to right, glass, and a mirror that shows what is behind the eye.
Model row_of_cubes() {
  Model model;
  const int red = add_material(model, paint({0.7f, 0.2f, 0.1f}, 0.4f));
  for (int i = -6; i <= 6; ++i)
    add_cube(model, "Cube", 0.15f, red, {0.5f * static_cast<float>(i), 0.0f, i % 2 == 0 ? -2.0f : 1.5f});
  Material pane = paint({0.2f, 0.4f, 0.9f}, 0.1f);
  pane.base_colour.a = 0.4f;
  pane.alpha_mode = AlphaMode::blend;
  add_rectangle(model, "Pane", {0.4f, 0.3f}, add_material(model, pane), {0.0f, 0.1f, -1.0f});
  add_rectangle(model, "Mirror", {0.3f, 0.1f}, add_material(model, paint(vec3(1.0f), 0.0f, 1.0f)),
                {-0.3f, 0.35f, -1.2f});
  return model;
}

struct LaterEyes final : Renderer::Finish {
  explicit LaterEyes(const std::array<View, 2>& views) : later(views) {}
  void record(VkCommandBuffer, GpuImage&, int) override { ++recorded; }
  std::span<const View> late_views() override {
    CHECK(recorded == 1);  // late_views() is called after everything else was recorded
    return later;
  }
  std::array<View, 2> later;
  int recorded = 0;
};

std::vector<float> read_depth(Gpu& gpu, GpuImage& depth, std::uint32_t eye) {
  const Image raw = read_back(gpu, depth, eye);
  std::vector<float> values(raw.rgba.size() / 4);
  std::memcpy(values.data(), raw.rgba.data(), raw.rgba.size());
  return values;
}

// Whether the driver resolves multisampled depth into layer 1 of an image if a pass draws into that layer only. Lavapipe
// of Mesa 22.3 and 25.0 does not.
bool resolves_depth_of_second_layer(Gpu& gpu) {
  constexpr std::uint32_t kSide = 4;
  ImageDesc desc{.width = kSide, .height = kSide, .layers = 2, .format = kDepthFormat};
  desc.usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
  EyeImage resolved(gpu, desc);
  desc.samples = VK_SAMPLE_COUNT_4_BIT;
  EyeImage samples(gpu, desc);
  const auto everywhere_half_deep = compile_glsl("vert", R"(#version 450
void main() { gl_Position = vec4(gl_VertexIndex % 2 * 4 - 1, gl_VertexIndex / 2 * 4 - 1, 0.5, 1.0); })");
  const PipelineLayout layout = make_pipeline_layout(gpu, {}, 0);
  const Pipeline pipeline = make_pipeline(gpu, {.vertex = everywhere_half_deep,
                                                .layout = layout.get(),
                                                .depth = kDepthFormat,
                                                .samples = desc.samples,
                                                .depth_use = Depth::write});
  run_once(gpu, [&](VkCommandBuffer commands) {
    transition(commands, samples.image, ImageUse::depth_target);
    transition(commands, resolved.image, ImageUse::depth_resolved);
    const Attachment depth{.view = samples.one[1].get(), .resolved = resolved.one[1].get()};
    begin_rendering(commands, samples.image.extent(), 1, nullptr, &depth);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.get());
    vkCmdSetCullMode(commands, VK_CULL_MODE_NONE);
    vkCmdSetFrontFace(commands, VK_FRONT_FACE_COUNTER_CLOCKWISE);
    vkCmdDraw(commands, 3, 1, 0, 0);
    vkCmdEndRendering(commands);
    transition(commands, resolved.image, ImageUse::copy_from);
  });
  return read_depth(gpu, resolved.image, 1).front() == 0.5f;
}

}  // namespace

TEST_CASE("a frame recorded for one head pose and given a later one is drawn from the later one") {
  GpuFixture fixture;
  const Model model = row_of_cubes();
  FrameScene scene = scene_at_rest(model);
  scene.sun = Sun{};
  scene.mirror = model.node("Mirror");
  const EyePose before = look_at({0, 0, 0}, {0, 0, -1});
  const EyePose after = look_at({0.01, -0.004, 0.006}, {0.052, 0.02, -1});  // by 2.75 deg (9.2 ms at 300 deg/s)
  for (const EyePasses passes : {EyePasses::layered, EyePasses::one_by_one}) {
    const RenderConfig config = for_headset(1, passes);
    CAPTURE(static_cast<int>(passes));
    Renderer renderer(fixture.gpu(), config);
    renderer.set_model(model);
    const std::array<View, 2> early = eyes_of(config, before), late = eyes_of(config, after);
    renderer.draw(scene, late);
    const std::array<Image, 2> expected{renderer.read_eye(0), renderer.read_eye(1)};
    LaterEyes later(late);
    renderer.draw(scene, early, {}, later);
    for (int eye = 0; eye < 2; ++eye) {
      CAPTURE(eye);
      CHECK(difference(renderer.read_eye(eye), expected[static_cast<std::size_t>(eye)]).worst <= 1);
    }
    renderer.draw(scene, early);  // without late views the pictures differ
    CHECK(difference(renderer.read_eye(0), expected[0], 3).fraction_beyond > 0.05);
  }
}

TEST_CASE("a frame that keeps its depth has near plane / distance at each pixel of each eye, at 1 and 4 samples") {
  GpuFixture fixture;
  Model model;
  const int grey = add_material(model, paint(vec3(0.5f)));
  add_rectangle(model, "Wall", {4.0f, 4.0f}, grey, {0.0f, 0.0f, -2.5f});
  add_rectangle(model, "Sign", {0.2f, 0.2f}, grey, {0.0f, 0.0f, -0.8f});
  double back = 0.0;  // [m] differs in each picture, so that memory of an earlier one cannot pass for a resolved depth
  for (const int samples : {1, 4}) {
    for (const EyePasses passes : {EyePasses::layered, EyePasses::one_by_one}) {
      back += 0.02;
      if (samples == 4 && passes == EyePasses::one_by_one && !resolves_depth_of_second_layer(fixture.gpu())) {
        MESSAGE("not tested: four samples, eye by eye, because this driver leaves depth's layer 1 unresolved");
        continue;
      }
      CAPTURE(samples);
      CAPTURE(static_cast<int>(passes));
      const RenderConfig config = for_headset(samples, passes);
      Renderer renderer(fixture.gpu(), config);
      renderer.set_model(model);
      const std::array<View, 2> views = eyes_of(config, look_at({0, 0, back}, {0, 0, -1}));
      renderer.draw(scene_at_rest(model), views);
      for (std::uint32_t eye = 0; eye < 2; ++eye) {
        const std::vector<float> depth = read_depth(fixture.gpu(), renderer.depth(), eye);
        double worst = 0.0;
        int sign = 0;
        for (int y = 0; y < config.height; ++y) {
          for (int x = 0; x < config.width; ++x) {
            const int at = y * config.width + x;
            const double measured = depth[static_cast<std::size_t>(at)];
            const glm::dvec3 left = project(views[eye], {-0.2, 0.2, -0.8}, {config.width, config.height});
            const glm::dvec3 right = project(views[eye], {0.2, -0.2, -0.8}, {config.width, config.height});
            const bool inside = x > left.x + 1 && x + 2 < right.x && y > left.y + 1 && y + 2 < right.y;
            const bool outside = x + 2 < left.x || x > right.x + 1 || y + 2 < left.y || y > right.y + 1;
            if (!inside && !outside) continue;
            sign += inside;
            worst = std::max(worst, std::abs(measured * (back + (inside ? 0.8 : 2.5)) / kNear - 1.0));
          }
        }
        CAPTURE(eye);
        CHECK(sign > 300);
        CHECK(worst < 1e-5);
      }
    }
  }
}
