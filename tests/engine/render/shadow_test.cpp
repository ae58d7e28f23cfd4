// Compares sun shadows with ray casting.
#include <algorithm>
#include <random>

#include "engine/render/shadow_fit.h"
#include "tests/engine/render/render_bench.h"

using namespace gearshift::engine;
using namespace gearshift::test;
using glm::dvec3;
using glm::vec3;

namespace {

constexpr float kHalf = 0.3f, kHeight = 0.6f;
const vec3 kSun{0.5f, 1.0f, 0.3f};

// True if the ray from a point of the floor towards the sun hits the blocker, a square around `centre`.
bool blocked(dvec3 point, dvec3 centre) {
  const dvec3 hit = point + dvec3(kSun) * (centre.y - point.y) / static_cast<double>(kSun.y);
  return std::abs(hit.x - centre.x) < kHalf && std::abs(hit.z - centre.z) < kHalf;
}

// A floor and a movable horizontal square above it.
struct Yard {
  Yard() {
    add_floor(model, "Floor", 1.5f, add_material(model, paint(vec3(0.6f))), 0.0f);
    Material thin = paint(vec3(0.6f));
    add_floor(model, "Blocker", kHalf, add_material(model, thin), kHeight);
    scene = scene_at_rest(model);
    scene.sun = {kSun, vec3(3.0f)};
  }
  void move_blocker(vec3 to) { scene.nodes[1].world = glm::translate(glm::mat4(1.0f), to); }
  Model model;
  FrameScene scene;
};

// Fraction of the floor's points that are lit although their ray to the sun is blocked, or dark although it is free.
// Points hidden by the blocker are skipped.
double fraction_misjudged(Renderer& renderer, const FrameScene& scene, dvec3 blocker) {
  const View view = view_at(renderer.config(), look_at({0, 3.0, 1.8}, {0, 0, 0}));
  renderer.draw(scene, {&view, 1});
  const Image picture = renderer.read_eye(0);
  int wrong = 0, count = 0;
  for (int j = 0; j < 100; ++j) {
    for (int i = 0; i < 100; ++i) {
      const dvec3 point{-1.2 + 0.024 * i, 0.0, -1.2 + 0.024 * j};
      const dvec3 eye(view.eye), hit = point + (eye - point) * blocker.y / eye.y;
      if (std::abs(hit.x - blocker.x) < kHalf + 0.02 && std::abs(hit.z - blocker.z) < kHalf + 0.02) continue;
      const dvec3 at = project(view, point, {picture.width, picture.height});
      const bool dark = picture.pixel(static_cast<int>(at.x), static_cast<int>(at.y))[1] < 120;
      wrong += dark != blocked(point, blocker) ? 1 : 0;
      ++count;
    }
  }
  return static_cast<double>(wrong) / count;
}

RenderConfig shadowed(int side) {
  RenderConfig config = small_picture(400, 300);
  config.shadow_side = side;
  return config;
}

}  // namespace

TEST_CASE("a blocker's shadow on a floor is where rays say: 1 % misjudged at 1024 texels, more at 64") {
  GpuFixture fixture;
  Yard yard;
  const dvec3 at{0.0, kHeight, 0.0};
  std::array<double, 2> fraction{};
  for (std::size_t i = 0; i < 2; ++i) {
    Renderer renderer(fixture.gpu(), shadowed(i == 0 ? 1024 : 64));
    renderer.set_environment(constant_sky(vec3(0.02f)));
    renderer.set_model(yard.model);
    fraction[i] = fraction_misjudged(renderer, yard.scene, at);
  }
  MESSAGE("misjudged: " << 100.0 * fraction[0] << " % at 1024, " << 100.0 * fraction[1] << " % at 64");
  CHECK(fraction[0] < 0.01);
  CHECK(fraction[1] > fraction[0]);
  RenderConfig none = shadowed(0);
  Renderer renderer(fixture.gpu(), none);
  renderer.set_environment(constant_sky(vec3(0.02f)));
  renderer.set_model(yard.model);
  // Without shadows, the shadowed points are misjudged, so the comparison can detect errors.
  CHECK(fraction_misjudged(renderer, yard.scene, at) > 0.03);
}

TEST_CASE("a shadow follows its caster from frame to frame, and disappears with it") {
  GpuFixture fixture;
  Yard yard;
  Renderer renderer(fixture.gpu(), shadowed(512));
  renderer.set_environment(constant_sky(vec3(0.02f)));
  renderer.set_model(yard.model);
  CHECK(fraction_misjudged(renderer, yard.scene, {0.0, kHeight, 0.0}) < 0.02);
  for (const float x : {0.1f, 0.5f, -0.4f, -0.4f, 0.0f}) {
    yard.move_blocker({x, kHeight, -0.2f});
    CHECK(fraction_misjudged(renderer, yard.scene, {x, kHeight, -0.2}) < 0.02);
  }
  yard.scene.nodes[1].visible = false;
  CHECK(fraction_misjudged(renderer, yard.scene, {50.0, kHeight, 0.0}) < 0.001);
  yard.scene.nodes[1].visible = true;
  CHECK(fraction_misjudged(renderer, yard.scene, {0.0, kHeight, -0.2}) < 0.02);
  yard.scene.nodes[1].opacity = 0.5f;  // a translucent object casts no shadow
  const View view = view_at(renderer.config(), look_at({0, 3.0, 1.8}, {0, 0, 0}));
  renderer.draw(yard.scene, {&view, 1});
  const Image ghost = renderer.read_eye(0);
  const dvec3 shade = project(view, {-0.45, 0.0, -0.38}, {400, 300});
  CHECK(ghost.pixel(int(shade.x), int(shade.y))[1] > 120);
}

TEST_CASE("a double-sided face with the sun behind it does not shadow its own back") {
  GpuFixture fixture;
  Model model;
  Material thin = paint(vec3(0.6f));
  thin.double_sided = true;
  add_floor(model, "Floor", 1.5f, add_material(model, thin), 0.0f);
  FrameScene scene = scene_at_rest(model);
  scene.sun = {kSun, vec3(3.0f)};
  scene.nodes[0].world = glm::rotate(glm::mat4(1.0f), 3.14159265f, vec3(1.0f, 0.0f, 0.0f));
  std::array<Image, 2> pictures;
  for (std::size_t i = 0; i < 2; ++i) {
    Renderer renderer(fixture.gpu(), shadowed(i == 0 ? 256 : 0));
    renderer.set_environment(constant_sky(vec3(0.02f)));
    renderer.set_model(model);
    const View view = view_at(renderer.config(), look_at({0, 3.0, 1.8}, {0, 0, 0}));
    renderer.draw(scene, {&view, 1});
    pictures[i] = renderer.read_eye(0);
  }
  CHECK(pictures[1].pixel(200, 150)[1] > 120);  // the floor is lit
  CHECK(difference(pictures[0], pictures[1]).worst <= 1);
}

TEST_CASE("light falls through a mask's holes") {
  GpuFixture fixture;
  Model model;
  model.textures.push_back({.pixels = {2, 1, {255, 255, 255, 255, 255, 255, 255, 0}}, .linear = false});
  Material half = paint(vec3(0.6f));
  half.alpha_mode = AlphaMode::mask;
  half.base_colour_map = {.texture = 0};
  add_floor(model, "Floor", 1.5f, add_material(model, paint(vec3(0.6f))), 0.0f);
  add_floor(model, "Blocker", kHalf, add_material(model, half), kHeight);
  FrameScene scene = scene_at_rest(model);
  scene.sun = {kSun, vec3(3.0f)};
  Renderer renderer(fixture.gpu(), shadowed(512));
  renderer.set_environment(constant_sky(vec3(0.02f)));
  renderer.set_model(model);
  const View view = view_at(renderer.config(), look_at({0, 3.0, 1.8}, {0, 0, 0}));
  renderer.draw(scene, {&view, 1});
  const Image picture = renderer.read_eye(0);
  const auto light = [&](double x) {  // light at the floor point whose ray to the sun crosses the blocker's plane at x
    const dvec3 at = project(view, {x - 0.6 * 0.5, 0.0, -0.25 - 0.6 * 0.3}, {400, 300});
    return picture.pixel(int(at.x), int(at.y))[1];
  };
  CHECK(light(-0.15) < 120);
  CHECK(light(0.15) > 120);
}

TEST_CASE("a face at a slant to the sun does not shadow itself, nor does a closed box shadow its lit sides") {
  GpuFixture fixture;
  Renderer with(fixture.gpu(), shadowed(256));
  RenderConfig config = shadowed(0);
  Renderer without(fixture.gpu(), config);
  Model model;
  add_cube(model, "Box", 0.5f, add_material(model, paint(vec3(0.6f))), {0, 0.5f, 0});
  for (const vec3 sun : {vec3(1.0f, 1.0f, 1.0f), vec3(0.3f, 1.0f, 0.2f), vec3(0.15f, 0.2f, 1.0f)}) {
    FrameScene scene = scene_at_rest(model);
    scene.sun = {sun, vec3(3.0f)};
    std::array<Image, 2> pictures;
    for (std::size_t i = 0; i < 2; ++i) {
      Renderer& renderer = i == 0 ? with : without;
      renderer.set_environment(constant_sky(vec3(0.02f)));
      renderer.set_model(model);
      const View view = view_at(config, look_at({1.5, 1.8, 2.0}, {0, 0.4, 0}));
      renderer.draw(scene, {&view, 1});
      pictures[i] = renderer.read_eye(0);
    }
    const double fraction = difference(pictures[0], pictures[1], 12).fraction_beyond;
    CAPTURE(sun.y);
    CHECK(fraction < 0.01);
  }
}

namespace {

constexpr int kSide = 512;

std::vector<vec3> corners(vec3 centre, float half) {
  std::vector<vec3> points;
  for (int i = 0; i < 8; ++i) points.push_back(centre + half * vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
  return points;
}

glm::vec2 texels(const ShadowFit& fit, vec3 point) {
  return float(kSide) * glm::vec2(fit.shadow_from_world * glm::vec4(point, 1.0f));
}

}  // namespace

TEST_CASE("the map moves in whole texels: a point keeps its place within its texel while the view moves") {
  const vec3 centre(0.3f, 0.2f, -0.5f), mark(1.0f, 0.5f, -1.0f);
  const ShadowFit fit = fit_shadow(corners(centre, 1.0f), kSun, kSide);
  for (const vec3 step : {vec3(0.001f, 0, 0), vec3(0.0123f, 0.2f, -0.07f), vec3(-1, 0.5f, 2)}) {
    const ShadowFit moved = fit_shadow(corners(centre + step, 1.0f), kSun, kSide);
    const glm::vec2 shift = texels(moved, mark) - texels(fit, mark);
    CHECK(moved.texel == fit.texel);
    CHECK(glm::length(shift - glm::round(shift)) < 0.02f);
  }
}

TEST_CASE("few of 400 small steps of the eye change the map") {
  int changes = 0;
  glm::mat4 last(0.0f);
  for (int i = 0; i < 400; ++i) {
    const vec3 at(0.3f + 0.0005f * float(i), 0.2f, -0.5f);
    const glm::mat4 now = fit_shadow(corners(at, 1.0f), kSun, kSide).clip_from_world;
    changes += now != last ? 1 : 0;
    last = now;
  }
  MESSAGE("0.2 m in 400 steps: " << changes << " maps");
  CHECK(changes <= 6);
}

TEST_CASE("the map holds the points and a margin, is less than 1.5 times as wide, and keeps casters in front of them") {
  const vec3 sun = glm::normalize(kSun);
  for (const float half : {0.01f, 0.3f, 1.0f, 7.0f}) {
    const std::vector<vec3> points = corners({1.0f, 2.0f, 3.0f}, half);
    const ShadowFit fit = fit_shadow(points, kSun, kSide);
    glm::vec2 low(1e9f), high(-1e9f);
    for (const vec3 point : points) {
      const glm::vec4 clip = fit.clip_from_world * glm::vec4(point, 1.0f);
      CHECK(clip.z >= 0.0f);
      CHECK((fit.clip_from_world * glm::vec4(point + 0.9f * kCasterReach * sun, 1.0f)).z <= 1.0f);
      low = glm::min(low, texels(fit, point));
      high = glm::max(high, texels(fit, point));
    }
    CHECK(std::min(low.x, low.y) > kShadowMargin - 0.01f);
    CHECK(std::max(high.x, high.y) < kSide - kShadowMargin + 0.01f);
    CHECK(std::max(high.x - low.x, high.y - low.y) > kSide / 1.5f);
    const auto depth = [&](float along) {
      return (fit.clip_from_world * glm::vec4(points[0] + along * half * sun, 1.0f)).z;
    };
    CHECK(depth(1.0f) > depth(0.0f));
  }
}

TEST_CASE("the visible part of a box lies within its visible corners, for an eye outside or inside the box") {
  const Box box{{-1.0f, -0.5f, -2.0f}, {1.5f, 0.5f, 1.0f}};
  std::mt19937 dice(3);
  std::uniform_real_distribution<float> throws(0.0f, 1.0f);
  for (const dvec3 eye : {dvec3(0.1, 0.2, 0.3), dvec3(4.0, 3.0, 5.0), dvec3(0.0, 0.0, 1.5), dvec3(-3.0, 0.0, -1.0)}) {
    const View view = view_from(look_at(eye, {0.3, -0.1, -1.0}), symmetric_fov(0.6, 1.5), 0.05);
    const glm::mat4 clip = view.clip_from_view * view.view_from_world;
    const std::vector<vec3> visible = visible_corners(box, {&clip, 1});
    // Along each of 20 random axes, no visible point of the box lies beyond the farthest of the visible corners, and
    // some point comes close to it.
    for (int k = 0; k < 20; ++k) {
      const vec3 axis = glm::normalize(vec3(throws(dice), throws(dice), throws(dice)) - 0.5f);
      float high = -1e9f, reached = -1e9f;
      for (const vec3 corner : visible) high = std::max(high, glm::dot(axis, corner));
      for (int i = 0; i < 4000; ++i) {
        const vec3 point = glm::mix(box.low, box.high, vec3(throws(dice), throws(dice), throws(dice)));
        const glm::vec4 at = clip * glm::vec4(point, 1.0f);
        if (at.w > 0.0f && std::abs(at.x) <= at.w && std::abs(at.y) <= at.w)
          reached = std::max(reached, glm::dot(axis, point));
      }
      REQUIRE(reached > -1e9f);
      CHECK(reached <= high + 1e-4f);
      CHECK(reached > high - 0.5f);
    }
  }
  const View away = view_from(look_at({0, 0, 4}, {0, 0, 9}), symmetric_fov(0.6, 1.5), 0.05);
  const glm::mat4 clip = away.clip_from_view * away.view_from_world;
  CHECK(visible_corners(box, {&clip, 1}).size() == 8);
}

TEST_CASE("the shadow of a straight edge is straight: within a fifth of a texel where it is half lit") {
  GpuFixture fixture;
  Yard yard;
  constexpr int kCoarse = 64;
  RenderConfig config = shadowed(kCoarse);
  config.width = config.height = 400;
  Renderer renderer(fixture.gpu(), config);
  renderer.set_environment(constant_sky(vec3(0.02f)));
  renderer.set_model(yard.model);
  // The sun's rays slope by 0.5 in x, so the blocker's right edge (x = 0.3 at height 0.6) casts its shadow at
  // x = 0.3 - 0.6 * 0.5 = 0. The camera looks straight down from below the blocker.
  const View view = view_at(config, look_at({0.001, 0.5, -0.18}, {0, 0, -0.18}, {0, 0, -1}));
  renderer.draw(yard.scene, {&view, 1});
  const Image picture = renderer.read_eye(0);
  std::vector<glm::dvec2> edge;  // [m] x and z of the half-lit points
  const auto light = [&](int x, int y) {
    const double s = picture.pixel(x, y)[1] / 255.0;
    return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
  };
  const double per_pixel = 2.0 * 0.5 * std::tan(0.5) / 400.0;  // [m] width of a pixel on the floor
  for (int y = 40; y < 360; ++y) {
    const double half = 0.5 * (light(0, y) + light(399, y));
    for (int x = 1; x < 400; ++x) {
      const double a = light(x - 1, y), b = light(x, y);
      if ((a < half) == (b < half)) continue;
      edge.push_back({per_pixel * (x - 200.0 + (half - a) / (b - a)), y * per_pixel});
      break;
    }
  }
  REQUIRE(edge.size() > 300);
  double mean = 0.0, square = 0.0;
  for (const glm::dvec2 point : edge) mean += point.x / static_cast<double>(edge.size());
  for (const glm::dvec2 point : edge) square += std::pow(point.x - mean, 2.0) / static_cast<double>(edge.size());
  const glm::mat4 clip = view.clip_from_view * view.view_from_world;
  const double texel = static_cast<double>(
      fit_shadow(visible_corners({{-1.5f, 0.0f, -1.5f}, {1.5f, kHeight, 1.5f}}, {&clip, 1}), kSun, kCoarse).texel);
  MESSAGE("texel " << 1e3 * texel << " mm, edge off by " << std::sqrt(square) / texel << " texels RMS");
  CHECK(std::sqrt(square) < 0.2 * texel);
}
