// Tests transparency and the order of blending.
#include "tests/engine/render/render_bench.h"

using namespace gearshift::engine;
using namespace gearshift::test;
using glm::vec3;

namespace {

Material glass(vec3 colour, float alpha) {
  Material material = paint(colour);
  material.base_colour.a = alpha;
  material.alpha_mode = AlphaMode::blend;
  return material;
}

Image picture_from(Renderer& renderer, const Model& model, const FrameScene& scene, glm::dvec3 eye) {
  renderer.set_model(model);
  const View view = view_at(renderer.config(), look_at(eye, {0, 0, 0}));
  renderer.draw(scene, {&view, 1});
  return renderer.read_eye(0);
}

}  // namespace

TEST_CASE("glass is drawn back to front, whatever its order in the file, seen from either side") {
  GpuFixture fixture;
  Renderer renderer(fixture.gpu(), small_picture());
  renderer.set_environment(constant_sky(vec3(1.0f)));
  Material red = glass({1, 0, 0}, 0.8f), blue = glass({0, 0, 1}, 0.8f);
  red.double_sided = blue.double_sided = true;
  Model one, other;
  add_rectangle(one, "Red", {1, 1}, add_material(one, red), {0, 0, 0.5f});
  add_rectangle(one, "Blue", {1, 1}, add_material(one, blue), {0, 0, -0.5f});
  add_rectangle(other, "Blue", {1, 1}, add_material(other, blue), {0, 0, -0.5f});
  add_rectangle(other, "Red", {1, 1}, add_material(other, red), {0, 0, 0.5f});
  const Image front = picture_from(renderer, one, scene_at_rest(one), {0, 0, 2});
  CHECK(difference(front, picture_from(renderer, other, scene_at_rest(other), {0, 0, 2})).worst == 0);
  CHECK(front.pixel(80, 60)[0] > front.pixel(80, 60)[2]);  // the nearer pane is red
  const Image back = picture_from(renderer, one, scene_at_rest(one), {0, 0, -2});
  CHECK(back.pixel(80, 60)[2] > back.pixel(80, 60)[0]);
}

TEST_CASE("solid objects hide the glass behind them, and are visible through the glass in front of them") {
  GpuFixture fixture;
  Renderer renderer(fixture.gpu(), small_picture());
  renderer.set_environment(constant_sky(vec3(0.0f)));
  Model model;
  add_rectangle(model, "Pane", {1, 1}, add_material(model, glass({0, 0, 0}, 0.25f)), {0, 0, 0.5f});
  add_rectangle(model, "Lamp", {0.3f, 0.3f}, add_material(model, lamp({0, 0.6f, 0})), {0, 0, -0.5f});
  const Image picture = picture_from(renderer, model, scene_at_rest(model), {0, 0, 2});
  FrameScene no_pane = scene_at_rest(model);
  no_pane.nodes[0].visible = false;
  const Image without_pane = picture_from(renderer, model, no_pane, {0, 0, 2});
  // `linear` converts a pixel value to linear light. Viewed along its normal, the pane reflects 4 % of the light and
  // transmits three quarters of the rest. The reflected environment is black here.
  const auto linear = [](int code) { return std::pow((code / 255.0 + 0.055) / 1.055, 2.4); };
  CHECK(linear(picture.pixel(80, 60)[1]) / linear(without_pane.pixel(80, 60)[1]) ==
        doctest::Approx(0.75 * 0.96).epsilon(0.03));
  FrameScene behind = scene_at_rest(model);
  behind.nodes[0].world[3].z = -1.0f;
  CHECK(difference(picture_from(renderer, model, behind, {0, 0, 2}), without_pane).fraction_beyond < 1.0);
  CHECK(picture_from(renderer, model, behind, {0, 0, 2}).pixel(80, 60)[1] == without_pane.pixel(80, 60)[1]);
}

TEST_CASE("a ghost is blended by its opacity, and opacity 1 and 0 are exact") {
  GpuFixture fixture;
  Renderer renderer(fixture.gpu(), small_picture());
  renderer.set_environment(constant_sky(vec3(0.0f)));
  Model model;
  add_rectangle(model, "Hand", {1, 1}, add_material(model, lamp({0.5f, 0, 0})), {0, 0, 0.5f});
  add_rectangle(model, "Behind", {1, 1}, add_material(model, lamp({0, 0, 0.5f})), {0, 0, -0.5f});
  FrameScene scene = scene_at_rest(model);
  const auto pixel = [&](float opacity) {
    scene.nodes[0].opacity = opacity;
    const Image picture = picture_from(renderer, model, scene, {0, 0, 2});
    return std::array<int, 2>{picture.pixel(80, 60)[0], picture.pixel(80, 60)[2]};
  };
  const auto solid = pixel(1.0f), half = pixel(0.5f), none = pixel(0.0f);
  CHECK(solid[1] <= half[1]);
  CHECK(half[1] < none[1]);
  CHECK(none[0] < half[0]);
  CHECK(half[0] < solid[0]);
}
