// Compares mirror pictures with the law of reflection.
#include "engine/render/mirror_view.h"
#include "tests/engine/render/render_bench.h"

using namespace gearshift::engine;
using namespace gearshift::test;
using glm::dvec2;
using glm::dvec3;
using glm::vec3;

namespace {

// A tilted mirror ahead, a green lamp behind the eye, a red one behind the mirror.
struct MirrorScene {
  MirrorScene() {
    const int silver = add_material(model, paint(vec3(1.0f), 0.0f, 1.0f));
    mirror = add_rectangle(model, "Mirror", {0.6f, 0.4f}, silver, {});
    green = add_cube(model, "Green", 0.05f, add_material(model, lamp({0, 2, 0})), {});
    red = add_cube(model, "Red", 0.05f, add_material(model, lamp({2, 0, 0})), {});
    scene = scene_at_rest(model);
    plane = glm::rotate(glm::translate(glm::mat4(1.0f), vec3(0.1f, 0.0f, -1.5f)), 0.2f, vec3(0.3f, 1.0f, 0.0f));
    world(mirror) = plane;
    scene.mirror = mirror;
  }
  glm::mat4& world(int node) { return scene.nodes[static_cast<std::size_t>(node)].world; }
  dvec3 mirrored(dvec3 point) const {
    const dvec3 normal = glm::normalize(dvec3(glm::vec3(plane[2])));
    return point - 2.0 * glm::dot(point - dvec3(glm::vec3(plane[3])), normal) * normal;
  }
  Model model;
  FrameScene scene;
  glm::mat4 plane{1.0f};
  int mirror = 0, green = 0, red = 0;
};

RenderConfig with_mirror(int height) {
  RenderConfig config = small_picture(320, 240);
  config.mirror_height = height;
  return config;
}

}  // namespace

TEST_CASE("a lamp behind the eye is seen in the mirror within 1 px of the law of reflection, by both eyes") {
  GpuFixture fixture;
  RenderConfig config = with_mirror(200);
  config.eyes = 2;
  Renderer renderer(fixture.gpu(), config);
  renderer.set_environment(constant_sky(vec3(0.0f)));
  MirrorScene rig;
  renderer.set_model(rig.model);
  rig.world(rig.red) = glm::translate(glm::mat4(1.0f), vec3(0.0f, 50.0f, 0.0f));
  const Fov fov = symmetric_fov(1.0, 4.0 / 3.0);
  const StereoEyes eyes = stereo_eyes(look_at({0, 0, 0}, {0.1, 0, -1.5}), fov, 0.064, 1.0);
  const std::vector<View> views{view_from(eyes.pose[0], eyes.fov[0], 0.05), view_from(eyes.pose[1], eyes.fov[1], 0.05)};
  for (const dvec3 lamp_at : {dvec3(0.9, 0.2, 0.5), dvec3(0.6, -0.1, 1.0), dvec3(1.2, 0.3, 0.3)}) {
    rig.world(rig.green) = glm::translate(glm::mat4(1.0f), vec3(lamp_at));
    renderer.draw(rig.scene, views);
    for (int eye = 0; eye < 2; ++eye) {
      const dvec3 expected = project(views[static_cast<std::size_t>(eye)], rig.mirrored(lamp_at), {320, 240});
      const dvec2 measured = centroid(renderer.read_eye(eye), 1);
      CAPTURE(lamp_at.x);
      CAPTURE(measured.x);
      CAPTURE(expected.x);
      CHECK(glm::length(measured - dvec2(expected)) < 1.0);
    }
  }
}

TEST_CASE("objects behind the mirror are not visible in it, and without a picture the mirror shows the sky") {
  GpuFixture fixture;
  Renderer renderer(fixture.gpu(), with_mirror(120));
  renderer.set_environment(constant_sky(vec3(0.0f)));
  MirrorScene rig;
  renderer.set_model(rig.model);
  const View view = view_at(renderer.config(), look_at({0, 0, 0}, {0.1, 0, -1.5}));
  rig.world(rig.green) = glm::translate(glm::mat4(1.0f), vec3(0.7f, 0.0f, 0.8f));
  rig.world(rig.red) = glm::translate(glm::mat4(1.0f), vec3(0.1f, 0.0f, -2.2f));
  renderer.draw(rig.scene, {&view, 1});
  const Image picture = renderer.read_eye(0);
  CHECK(centroid(picture, 1).x > 0.0);
  int redder = 0;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) redder += picture.pixel(x, y)[0] > picture.pixel(x, y)[1] ? 1 : 0;
  CHECK(redder == 0);
  rig.world(rig.red)[3] = glm::vec4(0.1f, 0.0f, -1.0f, 1.0f);  // in front of the mirror, the red lamp is visible
  renderer.draw(rig.scene, {&view, 1});
  CHECK(centroid(renderer.read_eye(0), 0, 150).x > 0.0);

  rig.world(rig.red)[3].y = 50.0f;
  renderer.resize(with_mirror(0));
  renderer.draw(rig.scene, {&view, 1});
  CHECK(centroid(renderer.read_eye(0), 1).x < 0.0);
}

TEST_CASE("an eye behind the mirror gets no mirrored view, and its frame is still drawn") {
  const MirrorWindow window = mirror_window(glm::mat4(1.0f), {{-0.5f, -0.2f, 0}, {0.5f, 0.2f, 0}});
  CHECK(mirror_view(window, {0, 0, 0.5f}).has_value());
  CHECK_FALSE(mirror_view(window, {0, 0, -0.5f}).has_value());
  CHECK_FALSE(mirror_view(window, {0, 0, 0}).has_value());
  GpuFixture fixture;
  Renderer renderer(fixture.gpu(), with_mirror(64));
  MirrorScene rig;
  renderer.set_model(rig.model);
  const View view = view_at(renderer.config(), look_at({0, 0, -4}, {0, 0, -1.5}));
  CHECK_NOTHROW(renderer.draw(rig.scene, {&view, 1}));
}

TEST_CASE("the window's corners are the picture's corners, for a mirror of any pose and scale") {
  glm::mat4 world = glm::rotate(glm::translate(glm::mat4(1.0f), vec3(1, 2, 3)), 0.7f, glm::normalize(vec3(1, 2, 1)));
  world = glm::scale(world, vec3(2.0f, 0.5f, 1.0f));
  const Box mesh{{-0.3f, -0.1f, 0.0f}, {0.2f, 0.15f, 0.0f}};
  const MirrorWindow window = mirror_window(world, mesh);
  const vec3 eye = vec3(world * glm::vec4(0.4f, -0.6f, 0.8f, 1.0f));
  const std::optional<View> view = mirror_view(window, eye);
  REQUIRE(view.has_value());
  for (const glm::vec2 corner : {glm::vec2(-0.3f, -0.1f), glm::vec2(0.2f, -0.1f), glm::vec2(-0.3f, 0.15f)}) {
    const glm::vec4 point = world * glm::vec4(corner, 0.0f, 1.0f);
    const dvec3 projected = project(*view, vec3(point), {1.0, 1.0});
    CHECK(projected.x == doctest::Approx(corner.x < 0.0f ? 1.0 : 0.0).epsilon(1e-3));
    CHECK(projected.y == doctest::Approx(corner.y < 0.0f ? 1.0 : 0.0).epsilon(1e-3));
    CHECK(std::abs(projected.z) < 1e-4);  // the mirror is in the near plane
    CHECK(glm::dot(window.u_row(), point) == doctest::Approx(projected.x).epsilon(1e-3));
    CHECK(glm::dot(window.v_row(), point) == doctest::Approx(projected.y).epsilon(1e-3));
  }
}
