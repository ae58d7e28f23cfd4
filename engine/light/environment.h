// Environment light: a sky over a road, its irradiance as spherical harmonics, its prefiltered reflections.
//
// This work is based on:
// Ravi Ramamoorthi, Pat Hanrahan. An Efficient Representation for Irradiance Environment Maps. 2001
// Brian Karis. Real Shading in Unreal Engine 4. 2013
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace gearshift::engine {

// Radiance arriving from a direction (unit vector, +Y up), without the sun, which is a separate light.
using Radiance = std::function<glm::vec3(glm::vec3 direction)>;

// The sky outside the cabin: zenith, haze at the horizon, glow of the sun, asphalt and verge below the horizon.
Radiance day_sky(glm::vec3 towards_sun);

// A smooth function of direction, sum_i c_i Y_i with real spherical harmonics Y_i up to degree 2 and nine coefficients
// c_i.
struct Harmonics {
  std::array<glm::vec3, 9> c{};
  glm::vec3 operator()(glm::vec3 direction) const;
};
inline constexpr int kIrradianceSamples = 32;  // samples along one side of a cube face
Harmonics project(const Radiance& radiance, int samples_per_face_side = kIrradianceSamples);

// Irradiance / pi as a function of the normal: the coefficients include the cosine lobe.
using Irradiance = Harmonics;
Irradiance project_irradiance(const Radiance& radiance, int samples_per_face_side = kIrradianceSamples);

// Cube map of prefiltered radiance. Level 0 is what a mirror reflects, the last level has roughness 1; level i has
// roughness i / (levels - 1). Faces in Vulkan's order (+X -X +Y -Y +Z -Z), texels are linear RGB half floats with alpha
// 1, rows from the top.
struct PrefilteredCube {
  int side = 0;                                    // [texels] at level 0
  std::vector<std::vector<std::uint16_t>> levels;  // 6 faces of (side >> level)^2 texels, 4 halves each
};
inline constexpr int kPrefilterSamples = 64;  // per texel
PrefilteredCube prefilter(const Radiance& radiance, int side = 64, int levels = 6, int samples = kPrefilterSamples);

// BRDF part of the split sum: scale and bias of F0, the reflectance at normal incidence, as functions of n.v > 0 and
// roughness. GGX with height-correlated Smith visibility. The table is sampled at texel centres: u = n.v, v =
// roughness.
glm::dvec2 environment_brdf(double n_dot_v, double roughness, int samples);  // evaluates the integral
struct BrdfTable {
  int side = 0;                                            // [texels]
  std::vector<std::uint16_t> texels;                       // 2 unorm16 per texel; first row: roughness 0
  glm::vec2 sample(float n_dot_v, float roughness) const;  // filters bilinearly, like a GPU
};
inline constexpr int kBrdfSide = 64;      // [texels]
inline constexpr int kBrdfSamples = 128;  // per texel
BrdfTable bake_brdf(int side = kBrdfSide, int samples = kBrdfSamples);

}  // namespace gearshift::engine
