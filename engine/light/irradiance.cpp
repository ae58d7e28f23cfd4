#include "engine/light/cube.h"
#include "engine/light/environment.h"

namespace gearshift::engine {

namespace {

// Real spherical harmonics to degree 2 (Ramamoorthi, Hanrahan 2001, eq. 3).
std::array<float, 9> harmonics(glm::vec3 d) {
  return {0.282095f,
          0.488603f * d.y,
          0.488603f * d.z,
          0.488603f * d.x,
          1.092548f * d.x * d.y,
          1.092548f * d.y * d.z,
          0.315392f * (3.0f * d.z * d.z - 1.0f),
          1.092548f * d.x * d.z,
          0.546274f * (d.x * d.x - d.y * d.y)};
}

// Zonal coefficients of the clamped cosine: pi, 2 pi / 3, pi / 4 (Ramamoorthi, Hanrahan 2001, eq. 8), divided by pi.
constexpr std::array<float, 9> kLobe{1.0f, 2.0f / 3.0f, 2.0f / 3.0f, 2.0f / 3.0f, 0.25f, 0.25f, 0.25f, 0.25f, 0.25f};

}  // namespace

glm::vec3 Harmonics::operator()(glm::vec3 direction) const {
  const std::array<float, 9> y = harmonics(direction);
  glm::vec3 sum(0.0f);
  for (std::size_t i = 0; i < y.size(); ++i) sum += c[i] * y[i];
  return sum;
}

Harmonics project(const Radiance& radiance, int samples_per_face_side) {
  const int side = samples_per_face_side;
  std::array<glm::dvec3, 9> sum{};
  for (int face = 0; face < 6; ++face) {
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        const glm::vec3 direction = cube_direction(face, side, x, y);
        const glm::dvec3 light = cube_texel_angle(side, x, y) * glm::dvec3(radiance(direction));
        const std::array<float, 9> h = harmonics(direction);
        for (std::size_t i = 0; i < h.size(); ++i) sum[i] += light * static_cast<double>(h[i]);
      }
    }
  }
  Harmonics projected;
  for (std::size_t i = 0; i < sum.size(); ++i) projected.c[i] = glm::vec3(sum[i]);
  return projected;
}

Irradiance project_irradiance(const Radiance& radiance, int samples_per_face_side) {
  Irradiance irradiance = project(radiance, samples_per_face_side);
  for (std::size_t i = 0; i < kLobe.size(); ++i) irradiance.c[i] *= kLobe[i];
  return irradiance;
}

}  // namespace gearshift::engine
