// Tests prefiltered reflections of skies for which the filtered result is known.
#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>

#include "engine/light/cube.h"
#include "engine/light/environment.h"

using namespace gearshift::engine;
using glm::vec3;

namespace {

vec3 texel(const PrefilteredCube& cube, int level, int face, int x, int y) {
  const int side = cube.side >> level, at = ((face * side + y) * side + x) * 4;
  const std::uint16_t* half = cube.levels[static_cast<std::size_t>(level)].data() + at;
  return {glm::unpackHalf1x16(half[0]), glm::unpackHalf1x16(half[1]), glm::unpackHalf1x16(half[2])};
}

}  // namespace

TEST_CASE("faces are oriented as in Vulkan: middle texels look along their axis, neighbours share an edge") {
  const vec3 axis[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (int face = 0; face < 6; ++face) {
    CHECK(cube_direction(face, 1, 0, 0) == axis[face]);
  }
  CHECK(glm::length(cube_point(4, 1, 0) - cube_point(0, -1, 0)) == 0.0f);  // right edge of +Z = left edge of +X
  CHECK(glm::length(cube_point(0, 1, 0) - cube_point(5, -1, 0)) == 0.0f);  // right edge of +X = left edge of -Z
  CHECK(glm::length(cube_point(4, 0, -1) - cube_point(2, 0, 1)) == 0.0f);  // top edge of +Z = bottom edge of +Y
  CHECK(glm::length(cube_point(4, 0, 1) - cube_point(3, 0, -1)) == 0.0f);  // bottom edge of +Z = top edge of -Y
  CHECK(cube_point(4, 0, -1).y == 1.0f);                                   // t = -1 is the top edge
}

TEST_CASE("level 0 is the radiance itself, as half floats") {
  const Radiance sky = day_sky({0.3f, 0.8f, -0.5f});
  const PrefilteredCube cube = prefilter(sky, 16, 3, 16);
  for (int face = 0; face < 6; ++face) {
    const vec3 measured = texel(cube, 0, face, 5, 11), expected = sky(cube_direction(face, 16, 5, 11));
    CHECK(glm::length(measured - expected) < 1e-3f * glm::length(expected));
  }
}

TEST_CASE("a constant sky stays the same at every roughness") {
  const PrefilteredCube cube = prefilter([](vec3) { return vec3(0.5f, 1.0f, 2.0f); }, 8, 4, 32);
  REQUIRE(cube.levels.size() == 4);
  for (int level = 0; level < 4; ++level)
    CHECK(glm::length(texel(cube, level, 3, 0, 0) - vec3(0.5f, 1.0f, 2.0f)) < 2e-3f);
}

TEST_CASE("the last level of a linear sky is its n.l weighted GGX lobe at roughness 1") {
  // At GGX alpha = 1, cos^2 of the half vector h is uniformly distributed. The light direction mirrors the normal n at
  // h, so its cosine cos_l = 2 cos_h^2 - 1 is uniform in (-1, 1). Weighted by cos_l itself over (0, 1), the mean of
  // cos_l is (1/3) / (1/2) = 2/3.
  const PrefilteredCube cube = prefilter([](vec3 d) { return vec3(2.0f + d.y); }, 8, 4, 1024);
  CHECK(texel(cube, 3, 2, 0, 0).x == doctest::Approx(2.0 + 2.0 / 3.0).epsilon(2e-3));
  CHECK(texel(cube, 3, 3, 0, 0).x == doctest::Approx(2.0 - 2.0 / 3.0).epsilon(2e-3));
  CHECK(texel(cube, 3, 0, 0, 0).x == doctest::Approx(2.0).epsilon(2e-3));
}

TEST_CASE("64 samples of the day sky are within 5 % RMS of 4096 samples, and rougher levels are flatter") {
  const Radiance sky = day_sky({0.35f, 0.80f, -0.48f});
  const PrefilteredCube coarse = prefilter(sky, 32, 6), fine = prefilter(sky, 32, 6, 4096);
  float last_spread = 1e9f;
  for (int level = 1; level < 6; ++level) {
    const int side = 32 >> level;
    float squares = 0.0f, low = 1e9f, high = 0.0f;
    for (int face = 0; face < 6; ++face)
      for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
          const vec3 a = texel(coarse, level, face, x, y), b = texel(fine, level, face, x, y);
          squares += glm::dot(a - b, a - b) / glm::dot(b, b) / static_cast<float>(6 * side * side);
          low = std::min(low, b.x);
          high = std::max(high, b.x);
        }
    CAPTURE(level);
    CHECK(std::sqrt(squares) < 0.05f);
    MESSAGE("level " << level << ": " << 100.0f * std::sqrt(squares) << " % RMS");
    CHECK(high - low < last_spread);
    last_spread = high - low;
  }
}
