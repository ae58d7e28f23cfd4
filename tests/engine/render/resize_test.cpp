// A resized renderer draws the same picture as a new renderer of the new size, and a change of size compiles no
// pipeline.
#include "tests/engine/render/counted_pipelines.h"
#include "tests/engine/render/render_bench.h"

using namespace gearshift::engine;
using namespace gearshift::test;
using glm::vec3;

namespace {

// A floor, a sunlit cube above it, and a mirror beside it.
Model yard() {
  Model model;
  add_floor(model, "Floor", 1.5f, add_material(model, paint(vec3(0.6f))), 0.0f);
  add_cube(model, "Cube", 0.2f, add_material(model, paint(vec3(0.7f, 0.2f, 0.1f))), {0.3f, 0.4f, 0.0f});
  add_rectangle(model, "Mirror", {0.5f, 0.3f}, add_material(model, paint(vec3(0.9f), 0.05f, 1.0f)),
                {-0.4f, 0.4f, -0.8f});
  return model;
}

RenderConfig sized(int width, int height) {
  RenderConfig config;
  config.width = width;
  config.height = height;
  config.shadow_side = 256;
  config.mirror_height = 32;
  return config;
}

std::vector<Image> draw_eyes(Renderer& renderer, const Model& model) {
  FrameScene scene = scene_at_rest(model);
  scene.sun.irradiance = vec3(3.0f);
  scene.mirror = 2;
  const View view = view_at(renderer.config(), look_at({0, 1.0, 2.0}, {0, 0.3, 0}));
  const std::vector<View> views(static_cast<std::size_t>(renderer.config().eyes), view);
  renderer.draw(scene, views);
  std::vector<Image> pictures;
  for (int eye = 0; eye < renderer.config().eyes; ++eye) pictures.push_back(renderer.read_eye(eye));
  return pictures;
}

}  // namespace

TEST_CASE("after any resize, a renderer draws the same picture as a new one") {
  GpuFixture fixture;
  const Model model = yard();
  Renderer renderer(fixture.gpu(), sized(160, 120));
  renderer.set_model(model);
  std::vector<RenderConfig> steps(8, sized(200, 90));
  steps[1].samples = 4;
  steps[2].shadow_side = 64;
  steps[3].eyes = 2;
  steps[4].mirror_height = 16;
  steps[5] = sized(33, 257);
  steps[5].eyes = 2;
  steps[5].samples = 4;
  steps[6] = sized(1, 1);
  steps[7] = sized(160, 120);
  draw_eyes(renderer, model);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    CAPTURE(i);
    renderer.resize(steps[i]);
    Renderer fresh(fixture.gpu(), steps[i]);
    fresh.set_model(model);
    const std::vector<Image> actual = draw_eyes(renderer, model), expected = draw_eyes(fresh, model);
    REQUIRE(actual.size() == expected.size());
    for (std::size_t eye = 0; eye < actual.size(); ++eye) CHECK(difference(actual[eye], expected[eye]).worst == 0);
  }
}

TEST_CASE("a changed size compiles no shader; a changed number of samples does") {
  GpuFixture fixture;
  const Model model = yard();
  Renderer renderer(fixture.gpu(), sized(160, 120));
  renderer.set_model(model);
  draw_eyes(renderer, model);
  const int before = compiled_pipelines;
  CHECK(before > 3);
  for (const int width : {161, 300, 80, 160}) {
    renderer.resize(sized(width, 100));
    draw_eyes(renderer, model);
  }
  CHECK(compiled_pipelines == before);
  RenderConfig smooth = sized(160, 120);
  smooth.samples = 4;
  renderer.resize(smooth);
  draw_eyes(renderer, model);
  CHECK(compiled_pipelines > before);
}
