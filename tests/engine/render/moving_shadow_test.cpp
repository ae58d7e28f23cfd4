// Tests the cached shadow of static casters, with other casters moving over it.
#include "tests/engine/render/render_bench.h"

using namespace gearshift::engine;
using namespace gearshift::test;
using glm::vec3;

namespace {

// A floor with a static cube and a moving cube, under a slanting sun.
struct MovingYard {
  Model model;
  int mover = kNone;
  FrameScene scene;
  RenderConfig config = small_picture();
  View view;

  MovingYard() {
    add_floor(model, "Floor", 3.0f, add_material(model, paint(vec3(0.6f))), -0.5f);
    const int box = add_material(model, paint({0.7f, 0.3f, 0.2f}));
    add_cube(model, "Still", 0.2f, box, {0.3f, 0.1f, 0.0f});
    mover = add_cube(model, "Mover", 0.25f, box, {});
    scene = scene_at_rest(model);
    scene.sun = Sun{};
    config.shadow_side = 256;
    view = view_at(config, look_at({0.5, 3.0, 3.0}, {0.0, -0.5, 0.0}));
  }
  void move(vec3 to, bool visible = true) {
    NodeState& node = scene.nodes[static_cast<std::size_t>(mover)];
    node.world = glm::translate(glm::mat4(1.0f), to);
    node.visible = visible;
  }
  Image render_with(Renderer& renderer) {
    renderer.draw(scene, {&view, 1});
    return renderer.read_eye(0);
  }
};

}  // namespace

TEST_CASE("a moving caster leaves no shadow behind: on any path, the picture equals that of a new renderer") {
  GpuFixture fixture;
  MovingYard yard;
  Renderer renderer(fixture.gpu(), yard.config);
  renderer.set_model(yard.model);
  Renderer unshadowed(fixture.gpu(), [&] {
    RenderConfig config = yard.config;
    config.shadow_side = 0;
    return config;
  }());
  unshadowed.set_model(yard.model);
  struct Step {
    vec3 at;
    bool visible = true;
  };
  // The steps move the caster across the static cube's shadow, out of the map and back, and hide and show the caster.
  for (const Step step : {Step{{-0.8f, 0.2f, 0.0f}}, Step{{-0.8f, 0.2f, 0.1f}}, Step{{0.1f, 0.3f, 0.3f}},
                          Step{{40.0f, 0.2f, 0.0f}}, Step{{0.9f, 0.2f, 0.8f}}, Step{{0.9f, 0.2f, 0.8f}, false},
                          Step{{0.9f, 0.2f, 0.8f}, false}, Step{{-2.7f, 0.0f, -2.7f}}, Step{{0.2f, 0.5f, 0.2f}}}) {
    yard.move(step.at, step.visible);
    Renderer new_renderer(fixture.gpu(), yard.config);
    new_renderer.set_model(yard.model);
    const Image picture = yard.render_with(renderer);
    CAPTURE(step.at.x);
    CHECK(difference(picture, yard.render_with(new_renderer)).worst == 0);
    CHECK(difference(picture, yard.render_with(unshadowed)).fraction_beyond >
          0.01);  // shadows are visible, so missing ones would be detected
  }
}
