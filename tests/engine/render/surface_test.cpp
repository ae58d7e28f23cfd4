// Compares shaded surfaces with closed-form values.
#include "engine/light/environment.h"
#include "tests/engine/render/render_bench.h"

using namespace gearshift::engine;
using namespace gearshift::test;
using glm::dvec3;
using glm::vec3;

namespace {

constexpr int kX = 80, kY = 60;  // [px] the picture's centre, where the view direction equals the normal

// A wall that fills the picture, viewed along its normal.
struct Wall {
  explicit Wall(const Material& material) {
    node = add_rectangle(model, "Wall", {3, 3}, add_material(model, material), {});
  }
  Model model;
  int node = 0;
};

class Studio {
 public:
  explicit Studio(RenderConfig wanted = small_picture()) : config(wanted), renderer(fixture.gpu(), wanted) {}
  Image photograph(const Model& model, const FrameScene& scene, dvec3 eye = {0, 0, 2}, dvec3 target = {0, 0, 0}) {
    renderer.set_model(model);
    const View view = view_at(config, look_at(eye, target));
    renderer.draw(scene, {&view, 1});
    return renderer.read_eye(0);
  }
  GpuFixture fixture;
  RenderConfig config;
  Renderer renderer;
};

}  // namespace

TEST_CASE("a wall under a constant sky shows the split sum, tone-mapped, within 1/255") {
  Studio studio;
  studio.renderer.set_environment(constant_sky({0.8f, 1.0f, 1.3f}));
  const dvec3 sky(0.8, 1.0, 1.3);
  for (const float roughness : {0.3f, 0.6f, 0.9f}) {
    for (const float metallic : {0.0f, 1.0f}) {
      const vec3 colour(0.7f, 0.35f, 0.1f);
      const Wall wall(paint(colour, roughness, metallic));
      const Image picture = studio.photograph(wall.model, scene_at_rest(wall.model));
      const glm::dvec2 ab = environment_brdf(1.0, roughness, 4096);
      const dvec3 f0 = glm::mix(dvec3(0.04), dvec3(colour), double(metallic)), reflectance = f0 * ab.x + ab.y;
      CAPTURE(roughness);
      CAPTURE(metallic);
      check_displayed(picture, kX, kY, sky * (reflectance + dvec3(colour) * (1.0 - metallic) * (1.0 - reflectance)));
    }
  }
}

TEST_CASE("a wall under the sun alone shows Lambert and GGX, within 1/255") {
  Studio studio;
  studio.renderer.set_environment(constant_sky(vec3(0.0f)));
  const dvec3 sun = glm::normalize(dvec3(0.4, 0.3, 0.8)), view(0, 0, 1), irradiance(2.0, 1.8, 1.5);
  const dvec3 colour(0.6, 0.5, 0.2), half = glm::normalize(sun + view);
  for (const double roughness : {0.25, 0.5, 0.9}) {
    const Wall wall(paint(vec3(colour), float(roughness)));
    FrameScene scene = scene_at_rest(wall.model);
    scene.sun = {vec3(5.0 * sun), vec3(irradiance)};
    // Terms of glTF 2.0, appendix B: GGX's D and V, Schlick's F. The diffuse part is reduced by the fraction of sky
    // light that the surface reflects.
    const double a2 = std::pow(roughness, 4.0), nl = sun.z, nv = 1.0, nh = half.z, vh = glm::dot(view, half);
    const double d = a2 / (glm::pi<double>() * std::pow(nh * nh * (a2 - 1.0) + 1.0, 2.0));
    const double v = 0.5 / (nl * std::sqrt(nv * nv * (1 - a2) + a2) + nv * std::sqrt(nl * nl * (1 - a2) + a2));
    const double f = 0.04 + 0.96 * std::pow(1.0 - vh, 5.0);
    const glm::dvec2 ab = environment_brdf(1.0, roughness, 4096);
    const dvec3 diffuse = colour * (1.0 - (0.04 * ab.x + ab.y)) / glm::pi<double>();
    CAPTURE(roughness);
    check_displayed(studio.photograph(wall.model, scene), kX, kY, irradiance * nl * (diffuse + d * v * f));
  }
}

TEST_CASE("the sky is shown as it is, times the exposure") {
  Studio studio;
  studio.renderer.set_environment(constant_sky({0.2f, 0.5f, 0.9f}));
  FrameScene scene;
  scene.exposure = 1.5f;
  const Image picture = studio.photograph(Model{}, scene);
  for (const int x : {0, 80, 159}) check_displayed(picture, x, 7, 1.5 * dvec3(0.2, 0.5, 0.9));
}

TEST_CASE("a lamp emits in proportion to its factor and is dark at 0") {
  Studio studio;
  studio.renderer.set_environment(constant_sky(vec3(0.0f)));
  const Wall wall(lamp({0.9f, 0.5f, 0.1f}));
  FrameScene scene = scene_at_rest(wall.model);
  for (const float factor : {1.0f, 0.4f, 0.0f}) {
    scene.nodes[0].emissive = factor;
    check_displayed(studio.photograph(wall.model, scene), kX, kY, double(factor) * dvec3(0.9, 0.5, 0.1));
  }
}

TEST_CASE("a face seen from behind is hidden, or lit on that side if double-sided; a mirrored node shows its front") {
  Studio studio;
  studio.renderer.set_environment([](vec3 d) { return vec3(d.z > 0.0f ? 1.0f : 0.1f); });
  Material material = paint(vec3(0.5f));
  const Wall single(material);
  material.double_sided = true;
  const Wall both(material);
  const Image front = studio.photograph(single.model, scene_at_rest(single.model));
  // From behind, a single-sided wall is invisible, so only the sky is visible.
  check_displayed(studio.photograph(single.model, scene_at_rest(single.model), {0, 0, -2}), kX, kY, dvec3(1.0), 2.0);
  const Image back = studio.photograph(both.model, scene_at_rest(both.model), {0, 0, -2});
  CHECK(back.pixel(kX, kY)[0] < front.pixel(kX, kY)[0] / 2);  // the back is lit by the darker sky
  FrameScene mirrored = scene_at_rest(single.model);
  mirrored.nodes[0].world = glm::scale(glm::mat4(1.0f), vec3(-1.0f, 1.0f, 1.0f));
  CHECK(difference(studio.photograph(single.model, mirrored), front).worst <= 1);
}

TEST_CASE("textures: both uv sets, a shifted display, KHR_texture_transform, vertex colours, a mask's holes") {
  Studio studio;
  studio.renderer.set_environment(constant_sky(vec3(0.0f)));
  // A texture of 2 x 2 texels; top: red, green; bottom: blue, white.
  Model model;
  model.textures.push_back(
      {.pixels = {2, 2, {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 40}}, .linear = false});
  Material material = lamp(vec3(1.0f));
  material.emissive_map = {.texture = 0, .uv_set = 1};
  const int on_uv1 = add_material(model, material);
  material.emissive_map = {.texture = 0, .offset = {0.5f, 0.0f}};
  const int shifted = add_material(model, material);
  // A rotation by 90 degrees, counter-clockwise as seen with v pointing down: (u, v) -> (v, -u).
  material.emissive_map = {.texture = 0, .rotation = glm::half_pi<float>()};
  const int turned = add_material(model, material);
  for (const int use : {on_uv1, shifted, turned})
    add_rectangle(model, "", {0.5f, 0.5f}, use, {1.2f * float(use) - 1.2f, 0, 0});
  std::vector<Vertex> coloured = rectangle(0.5f, 0.5f);
  for (Vertex& vertex : coloured) vertex.colour = 0xff00ff80u;
  Material white = paint(vec3(1.0f));
  add_node(model, "", add_mesh(model, coloured, kRectangle, add_material(model, white)), {0, 1.2f, 0});
  Material holes = lamp(vec3(1.0f));
  holes.alpha_mode = AlphaMode::mask;
  holes.base_colour_map = {.texture = 0};
  add_rectangle(model, "", {0.5f, 0.5f}, add_material(model, holes), {0, -1.2f, 0});

  FrameScene scene = scene_at_rest(model);
  scene.nodes[0].uv_shift = {0.5f, 0.0f};  // no effect: shifts only UV set 0, and this node uses UV set 1
  const View view = view_at(studio.config, look_at({0, 0, 4}, {0, 0, 0}));
  const auto colour_at = [&](const Image& picture, vec3 point) {
    const dvec3 at = project(view, point, {160, 120});
    const std::uint8_t* pixel = picture.pixel(int(at.x), int(at.y));
    return std::array{pixel[0] > 100, pixel[1] > 100, pixel[2] > 100};
  };
  const std::array red{true, false, false}, green{false, true, false}, blue{false, false, true};
  const std::array lit{true, true, true}, dark{false, false, false};
  const Image picture = studio.photograph(model, scene, {0, 0, 4});
  CHECK(colour_at(picture, {-1.45f, 0.25f, 0}) == red);
  CHECK(colour_at(picture, {-0.95f, 0.25f, 0}) == green);
  CHECK(colour_at(picture, {-0.25f, 0.25f, 0}) == green);  // shifted by half the texture's width, green is left of red
  CHECK(colour_at(picture, {0.25f, 0.25f, 0}) == red);
  // UV (0.25, 0.25) becomes (0.25, -0.25), which wraps to (0.25, 0.75): the lower left texel, blue. UV (0.75, 0.25)
  // becomes (0.25, -0.75), which wraps to (0.25, 0.25): the upper left texel, red.
  CHECK(colour_at(picture, {0.95f, 0.25f, 0}) == blue);
  CHECK(colour_at(picture, {1.45f, 0.25f, 0}) == red);
  CHECK(colour_at(picture, {-0.25f, -0.95f, 0}) == lit);
  CHECK(colour_at(picture, {0.25f, -1.45f, 0}) == dark);  // alpha 40/255 is below the cutoff

  scene.nodes[1].uv_shift = {0.5f, 0.0f};
  const Image next = studio.photograph(model, scene, {0, 0, 4});
  CHECK(colour_at(next, {-0.25f, 0.25f, 0}) == red);

  studio.renderer.set_environment(constant_sky(vec3(1.0f)));
  const Image lit_by_sky = studio.photograph(model, scene, {0, 0, 4});
  const dvec3 at = project(view, {0, 1.2f, 0}, {160, 120});
  const std::uint8_t* tinted = lit_by_sky.pixel(int(at.x), int(at.y));
  CHECK(tinted[1] > tinted[0] + 20);
  CHECK(tinted[0] > tinted[2] + 20);
}

TEST_CASE("baked occlusion darkens the sky's light by its strength") {
  Studio studio;
  studio.renderer.set_environment(constant_sky(vec3(1.0f)));
  Model model;
  model.textures.push_back({.pixels = {1, 1, {51, 0, 0, 255}}});  // 0.2
  Material material = paint(vec3(0.5f));
  material.occlusion_map = {.texture = 0, .uv_set = 1};
  material.occlusion_strength = 0.5f;
  add_rectangle(model, "Wall", {3, 3}, add_material(model, material), {});
  const double open = 1.0 + 0.5 * (0.2 - 1.0);
  const glm::dvec2 ab = environment_brdf(1.0, 1.0, 4096);
  const double reflectance = 0.04 * ab.x + ab.y;
  // Specular occlusion by Lagarde & de Rousiers 2014, listing 26, at n.v = 1 and roughness 1.
  const double specular = std::min(1.0, std::pow(1.0 + open, std::exp2(-17.0)) - 1.0 + open);
  check_displayed(studio.photograph(model, scene_at_rest(model)), kX, kY,
                  dvec3(0.5 * (1.0 - reflectance) * open + reflectance * specular));
}

TEST_CASE("a normal map changes the shading; without it the picture differs") {
  Model model;
  model.textures.push_back({.pixels = {2, 1, {218, 128, 218, 255, 38, 128, 218, 255}}, .linear = false});  // +-45 deg
  Material material = paint(vec3(0.6f));
  material.normal_map = {.texture = 0};
  add_rectangle(model, "Wall", {3, 3}, add_material(model, material), {});
  FrameScene scene = scene_at_rest(model);
  scene.sun = {{1.0f, 0.0f, 1.0f}, vec3(3.0f)};

  Studio with;
  with.renderer.set_environment(constant_sky(vec3(0.05f)));
  const Image bumpy = with.photograph(model, scene);
  CHECK(bumpy.pixel(40, 60)[0] > bumpy.pixel(120, 60)[0] + 60);  // the left half is tilted towards the sun
  CHECK(difference(bumpy, with.photograph(model, scene)).worst == 0);

  RenderConfig config = small_picture();
  config.normal_maps = false;
  Studio without(config);
  without.renderer.set_environment(constant_sky(vec3(0.05f)));
  CHECK(difference(bumpy, without.photograph(model, scene)).fraction_beyond > 0.5);
}

// A normal map only states directions, so the same wall is lit identically when modelled small and scaled up, or large
// and scaled down.
TEST_CASE("a normal map has the same strength on a node of any scale") {
  const auto wall = [](float scale) {
    Model model;
    model.textures.push_back({.pixels = {2, 1, {218, 128, 218, 255, 38, 128, 218, 255}}, .linear = false});
    Material material = paint(vec3(0.6f));
    material.normal_map = {.texture = 0};
    add_rectangle(model, "Wall", {3.0f / scale, 3.0f / scale}, add_material(model, material), {});
    model.nodes[0].scale = vec3(scale);
    return model;
  };
  Studio studio;
  studio.renderer.set_environment(constant_sky(vec3(0.05f)));
  const auto lit = [&](float scale) {
    const Model model = wall(scale);
    FrameScene scene = scene_at_rest(model);
    scene.sun = {{1.0f, 0.0f, 1.0f}, vec3(3.0f)};
    return studio.photograph(model, scene);
  };
  const Image as_modelled = lit(1.0f);
  CHECK(as_modelled.pixel(40, 60)[0] > as_modelled.pixel(120, 60)[0] + 60);
  for (const float scale : {0.01f, 0.5f, 100.0f}) {
    CAPTURE(scale);
    CHECK(difference(lit(scale), as_modelled).worst <= 1);
  }
}

// Tests every pass: in a hole (vertex alpha below the cutoff), the background is visible with one sample (depth
// prepass) and with four samples, and the sun shines through.
TEST_CASE("holes masked by vertex alpha are holes with one sample, with four samples, and for the sun") {
  Model model;
  std::vector<Vertex> fading = rectangle(1.0f, 1.0f);  // alpha 1 at the left edge, 0 at the right edge
  for (Vertex& vertex : fading) vertex.colour = vertex.position.x < 0.0f ? 0xffffffffu : 0x00ffffffu;
  Material mask = paint(vec3(0.0f));
  mask.alpha_mode = AlphaMode::mask;
  mask.alpha_cutoff = 0.5f;
  add_node(model, "Mask", add_mesh(model, fading, kRectangle, add_material(model, mask)), {0, 0, 0.5f});
  add_rectangle(model, "Wall", {3, 3}, add_material(model, paint(vec3(0.6f))), {});
  FrameScene scene = scene_at_rest(model);
  scene.sun = {{0.0f, 0.0f, 1.0f}, vec3(3.0f)};
  for (const int samples : {1, 4}) {
    CAPTURE(samples);
    RenderConfig config = small_picture();
    config.samples = samples;
    config.shadow_side = 512;
    Studio studio(config);
    studio.renderer.set_environment(constant_sky(vec3(0.0f)));
    const Image picture = studio.photograph(model, scene, {0, 0, 3});
    const View view = view_at(config, look_at({0, 0, 3}, {0, 0, 0}));
    const auto light = [&](double x) {
      const dvec3 at = project(view, {x, 0.0, 0.5}, {160, 120});
      return int(picture.pixel(int(at.x), int(at.y))[1]);
    };
    CHECK(light(-0.5) < 40);  // the black mask
    CHECK(light(0.5) > 120);  // the sunlit wall, seen through the hole
  }
}
