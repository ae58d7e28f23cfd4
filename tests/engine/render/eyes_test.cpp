// Checks the positions of drawn objects, and compares stereo pictures with single views.
#include "tests/engine/render/render_bench.h"

using namespace gearshift::engine;
using namespace gearshift::test;
using glm::dvec2;
using glm::dvec3;
using glm::vec3;

namespace {

constexpr double kIpd = 0.064, kScreen = 0.7;

std::vector<View> stereo_views(const RenderConfig& config, const EyePose& head, double near_plane = 0.05) {
  const Fov fov = symmetric_fov(1.0, static_cast<double>(config.width) / config.height);
  const StereoEyes eyes = stereo_eyes(head, fov, kIpd, kScreen);
  return {view_from(eyes.pose[0], eyes.fov[0], near_plane), view_from(eyes.pose[1], eyes.fov[1], near_plane)};
}

// A model of a floor that passes under and behind the eye, boxes near and far, glass and a mirror.
Model street() {
  Model model;
  add_floor(model, "Floor", 20.0f, add_material(model, paint({0.5f, 0.5f, 0.4f})), -0.2f);
  const int box = add_material(model, paint({0.7f, 0.2f, 0.1f}, 0.4f));
  add_cube(model, "Near", 0.15f, box, {0.2f, 0.0f, -0.25f});  // begins 0.10 m ahead; the near plane is at 0.05 m
  add_cube(model, "Far", 0.5f, box, {-1.0f, 0.3f, -4.0f});
  Material pane = paint({0.2f, 0.4f, 0.9f}, 0.1f);
  pane.base_colour.a = 0.4f;
  pane.alpha_mode = AlphaMode::blend;
  add_rectangle(model, "Pane", {0.4f, 0.3f}, add_material(model, pane), {0.0f, 0.1f, -1.0f});
  add_rectangle(model, "Mirror", {0.3f, 0.1f}, add_material(model, paint(vec3(1.0f), 0.0f, 1.0f)),
                {-0.4f, 0.4f, -1.2f});
  return model;
}

FrameScene sunlit_scene(const Model& model) {
  FrameScene scene = scene_at_rest(model);
  scene.sun = Sun{};
  scene.mirror = model.node("Mirror");
  return scene;
}

}  // namespace

TEST_CASE("the corners of a cube are drawn within 0.5 px of a pinhole camera's picture, in each eye") {
  GpuFixture fixture;
  RenderConfig config = small_picture(320, 240);
  config.eyes = 2;
  config.samples = 4;
  Renderer renderer(fixture.gpu(), config);
  renderer.set_environment(constant_sky(vec3(0.0f)));
  Model model;
  const int white = add_material(model, lamp(vec3(2.0f)));
  const int corner = add_cube(model, "Corner", 0.012f, white, {});
  renderer.set_model(model);
  const EyePose head = look_at({0.2, 0.3, 0.4}, {0.0, 0.0, -0.6});
  const std::vector<View> views = stereo_views(config, head);
  const double focal = 0.5 * 240.0 / std::tan(0.5);  // [px]
  double worst = 0.0;
  for (int i = 0; i < 8; ++i) {
    const dvec3 at{i & 1 ? 0.15 : -0.15, i & 2 ? 0.15 : -0.15, (i & 4 ? 0.15 : -0.15) - 0.6};
    FrameScene scene = scene_at_rest(model);
    scene.nodes[static_cast<std::size_t>(corner)].world = glm::translate(glm::mat4(1.0f), vec3(at));
    renderer.draw(scene, views);
    for (int eye = 0; eye < 2; ++eye) {
      const dvec3 from_head = glm::conjugate(head.orientation) * (at - head.position);
      const double z = -from_head.z, x = from_head.x - (eye == 0 ? -0.5 : 0.5) * kIpd;
      // The eyes look in parallel, and their frusta coincide at the distance kScreen. There, the centre of each eye's
      // picture is offset by half the eye distance.
      const dvec2 pinhole{160.0 + focal * (x / z + (eye == 0 ? -0.5 : 0.5) * kIpd / kScreen),
                          120.0 - focal * from_head.y / z};
      worst = std::max(worst, glm::length(centroid(renderer.read_eye(eye), 0) - pinhole));
    }
  }
  MESSAGE("worst " << worst << " px");
  CHECK(worst < 0.5);
}

TEST_CASE("each eye's picture equals a single view: geometry across the near plane, 1 and 4 samples, 1 and 2 passes") {
  GpuFixture fixture;
  const Model model = street();
  for (const int samples : {1, 4}) {
    RenderConfig config = small_picture(160, 120);
    config.samples = samples;
    config.shadow_side = 256;
    config.mirror_height = 32;
    Renderer single(fixture.gpu(), config);
    single.set_model(model);
    const std::vector<View> views = stereo_views(config, look_at({0, 0, 0}, {0, -0.05, -1}));
    FrameScene scene = sunlit_scene(model);
    // Both eyes see this box completely, so the shadow map is the same for both.
    scene.shadow_bounds = {{-1.5f, -0.25f, -5.0f}, {1.5f, 0.9f, -3.0f}};
    std::array<Image, 2> reference;
    for (std::size_t eye = 0; eye < 2; ++eye) {
      single.draw(scene, {&views[eye], 1});
      reference[eye] = single.read_eye(0);
    }
    // The two eyes see different pictures, so swapped eyes would be detected.
    REQUIRE(difference(reference[0], reference[1]).fraction_beyond > 0.1);
    for (const EyePasses passes : {EyePasses::layered, EyePasses::one_by_one}) {
      config.eyes = 2;
      config.eye_passes = passes;
      Renderer both(fixture.gpu(), config);
      CHECK(both.layered() == (passes == EyePasses::layered));
      both.set_model(model);
      both.draw(scene, views);
      CAPTURE(samples);
      CAPTURE(both.layered());
      for (int eye = 0; eye < 2; ++eye)
        CHECK(difference(both.read_eye(eye), reference[static_cast<std::size_t>(eye)]).worst <= 1);
    }
  }
}

TEST_CASE("objects out of sight are not drawn, and objects in sight are") {
  GpuFixture fixture;
  Renderer renderer(fixture.gpu(), small_picture());
  Model model;
  const int white = add_material(model, lamp(vec3(1.0f)));
  for (const vec3 at : {vec3(0, 0, -3), vec3(0, 0, 3), vec3(30, 0, -3), vec3(0, -30, -3), vec3(1.9f, 0, -3)})
    add_cube(model, "Cube", 0.2f, white, at);
  renderer.set_model(model);
  const View view = view_at(renderer.config(), look_at({0, 0, 0}, {0, 0, -1}));
  renderer.draw(scene_at_rest(model), {&view, 1});
  CHECK(renderer.draws() == 2);  // the cube straight ahead, and the cube that just reaches into the picture
  FrameScene hidden = scene_at_rest(model);
  hidden.nodes[0].visible = false;
  renderer.draw(hidden, {&view, 1});
  CHECK(renderer.draws() == 1);
}
