// This work is based on:
// Brian Karis. Real Shading in Unreal Engine 4. 2013 (n = v = r, weight n.l)
// Holger Dammertz. Hammersley Points on the Hemisphere. 2012
#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/packing.hpp>
#include <glm/mat3x3.hpp>

#include "engine/light/cube.h"
#include "engine/light/environment.h"

namespace gearshift::engine {

namespace {

// A light direction around a normal along z, and its weight.
struct LobeSample {
  glm::vec3 towards_light;
  float weight = 0.0f;
};

double radical_inverse(std::uint32_t i) {
  double inverse = 0.0, digit = 0.5;
  for (; i != 0; i >>= 1, digit *= 0.5) inverse += digit * (i & 1u);
  return inverse;
}

// Light directions from reflection at GGX half vectors h around the normal n. Only directions above the surface are
// returned: n.h > sqrt(1/2), i.e. random numbers u < 1 / (1 + alpha^2) with alpha = roughness^2. The samples are the
// same for all texels of a level.
std::vector<LobeSample> ggx_lobe(double roughness, int samples) {
  if (roughness == 0.0) return {{glm::vec3(0.0f, 0.0f, 1.0f), 1.0f}};
  const double a2 = std::pow(roughness, 4.0);
  std::vector<LobeSample> lobe;
  double sum = 0.0;
  for (int i = 0; i < samples; ++i) {
    const double u = (radical_inverse(static_cast<std::uint32_t>(i)) + 0.5 / samples) / (1.0 + a2);
    const double phi = 2.0 * glm::pi<double>() * (i + 0.5) / samples;
    const double n_dot_h = std::sqrt((1.0 - u) / (1.0 + (a2 - 1.0) * u)), aside = std::sqrt(1.0 - n_dot_h * n_dot_h);
    const glm::dvec3 half(aside * std::cos(phi), aside * std::sin(phi), n_dot_h);
    const glm::dvec3 light = 2.0 * n_dot_h * half - glm::dvec3(0.0, 0.0, 1.0);
    lobe.push_back({glm::vec3(light), static_cast<float>(light.z)});
    sum += light.z;
  }
  for (LobeSample& sample : lobe) sample.weight /= static_cast<float>(sum);
  return lobe;
}

// Returns an arbitrary orthonormal frame whose z axis is the normal.
glm::mat3 frame_about(glm::vec3 normal) {
  const glm::vec3 up = std::abs(normal.y) < 0.9f ? glm::vec3(0.0f, 1.0f, 0.0f) : glm::vec3(1.0f, 0.0f, 0.0f);
  const glm::vec3 x = glm::normalize(glm::cross(up, normal));
  return {x, glm::cross(normal, x), normal};
}

void filter_face(const Radiance& radiance, const std::vector<LobeSample>& lobe, int face, int side,
                 std::uint16_t* texel) {
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x, texel += 4) {
      const glm::mat3 frame = frame_about(cube_direction(face, side, x, y));
      glm::vec3 sum(0.0f);
      for (const LobeSample& sample : lobe) sum += sample.weight * radiance(frame * sample.towards_light);
      for (int c = 0; c < 3; ++c) texel[c] = glm::packHalf1x16(sum[c]);
      texel[3] = glm::packHalf1x16(1.0f);
    }
  }
}

}  // namespace

PrefilteredCube prefilter(const Radiance& radiance, int side, int levels, int samples) {
  PrefilteredCube cube;
  cube.side = side;
  std::vector<std::vector<LobeSample>> lobes;
  for (int level = 0; level < levels; ++level) {
    const auto width = static_cast<std::size_t>(std::max(1, side >> level));
    cube.levels.emplace_back(6 * width * width * 4);
    lobes.push_back(ggx_lobe(levels == 1 ? 0.0 : static_cast<double>(level) / (levels - 1), samples));
  }
  std::atomic<int> next{0};
  const auto work = [&] {
    for (int job; (job = next.fetch_add(1)) < 6 * levels;) {
      const int face = job % 6, width = std::max(1, side >> (job / 6));
      const auto level = static_cast<std::size_t>(job / 6);
      std::uint16_t* first = cube.levels[level].data() + 4L * face * width * width;
      filter_face(radiance, lobes[level], face, width, first);
    }
  };
  std::thread worker(work);
  work();
  worker.join();
  return cube;
}

}  // namespace gearshift::engine
