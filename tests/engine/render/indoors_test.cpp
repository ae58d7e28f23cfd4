// With two environments, indoor nodes are lit by the indoor environment, and all other nodes by the sky.
#include "tests/engine/render/render_bench.h"

using namespace gearshift::engine;
using namespace gearshift::test;
using glm::dvec3;
using glm::vec3;

namespace {

const dvec3 kOpen(0.3, 0.6, 1.1), kInside(0.5, 0.4, 0.2);

// One wall on the left and one on the right, matt or metallic.
struct TwoWalls {
  explicit TwoWalls(const Material& material) {
    const int paint = add_material(model, material);
    add_rectangle(model, "Left", {0.9f, 2.0f}, paint, {-1.0f, 0, 0});
    add_rectangle(model, "Right", {0.9f, 2.0f}, paint, {1.0f, 0, 0});
    scene = scene_at_rest(model);
  }
  Model model;
  FrameScene scene;
};

}  // namespace

TEST_CASE("an indoor wall reflects the indoor light by the split sum, within 1/255; an outdoor wall reflects the sky") {
  GpuFixture fixture;
  Renderer renderer(fixture.gpu(), small_picture());
  renderer.set_environment(constant_sky(vec3(kOpen)), constant_sky(vec3(kInside)));
  const vec3 colour(0.7f, 0.35f, 0.1f);
  for (const float metallic : {0.0f, 1.0f}) {
    TwoWalls walls(paint(colour, 0.6f, metallic));
    walls.scene.nodes[0].indoors = true;
    renderer.set_model(walls.model);
    const dvec3 f0 = glm::mix(dvec3(0.04), dvec3(colour), double(metallic));
    for (const double x : {-1.0, 1.0}) {
      const View view = view_at(renderer.config(), look_at({x, 0, 1}, {x, 0, 0}));
      renderer.draw(walls.scene, {&view, 1});
      const glm::dvec2 ab = environment_brdf(1.0, 0.6, 4096);
      const dvec3 reflectance = f0 * ab.x + ab.y;
      CAPTURE(x);
      check_displayed(
          renderer.read_eye(0), 80, 60,
          (x < 0.0 ? kInside : kOpen) * (reflectance + dvec3(colour) * (1.0 - metallic) * (1.0 - reflectance)));
    }
  }
}

TEST_CASE("the indoor light changes an indoor node, and not a bit of an outdoor node or of the sky") {
  GpuFixture fixture;
  Renderer renderer(fixture.gpu(), small_picture());
  TwoWalls walls(paint({0.5f, 0.5f, 0.5f}, 0.4f));
  walls.scene.nodes[0].indoors = true;
  renderer.set_model(walls.model);
  const Radiance open = day_sky({0.35f, 0.80f, -0.48f});
  const View view = view_at(renderer.config(), look_at({0, 0, 3}, {0, 0, 0}));
  const auto photograph = [&](const Radiance& indoors) {
    renderer.set_environment(open, indoors);
    renderer.draw(walls.scene, {&view, 1});
    return renderer.read_eye(0);
  };
  const Image same = photograph({}), dark = photograph(constant_sky(vec3(0.01f)));
  const int left = 50, right = 110;  // [px]
  for (int y = 30; y < 90; ++y) {
    CHECK(same.pixel(left, y)[1] > dark.pixel(left, y)[1] + 30);
    for (int x = 80; x < 160; ++x)  // the right half of the picture: wall and sky
      for (int c = 0; c < 3; ++c) REQUIRE(same.pixel(x, y)[c] == dark.pixel(x, y)[c]);
  }
  CHECK(same.pixel(left, 60)[1] == same.pixel(right, 60)[1]);  // no indoor environment: both sides look the same
}
