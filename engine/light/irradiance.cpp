#include <cmath>

#include "engine/light/cube.h"
#include "engine/light/environment.h"

namespace gearshift {

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

// The clamped cosine's zonal coefficients over pi: pi, 2 pi / 3, pi / 4 (ibid., eq. 8).
constexpr std::array<float, 9> kLobe{1.0f, 2.0f / 3.0f, 2.0f / 3.0f, 2.0f / 3.0f, 0.25f, 0.25f, 0.25f, 0.25f, 0.25f};

// Solid angle of the part of a face between its centre and (s, t): atan2(s t, sqrt(1 + s^2 + t^2)).
double corner_angle(double s, double t) {
  return std::atan2(s * t, std::sqrt(s * s + t * t + 1.0));
}

double texel_angle(int side, int x, int y) {
  const double texel = 2.0 / side, s = x * texel - 1.0, t = y * texel - 1.0;
  return corner_angle(s, t) - corner_angle(s + texel, t) - corner_angle(s, t + texel) +
         corner_angle(s + texel, t + texel);
}

}  // namespace

glm::vec3 Irradiance::operator()(glm::vec3 normal) const {
  const std::array<float, 9> y = harmonics(normal);
  glm::vec3 sum(0.0f);
  for (std::size_t i = 0; i < y.size(); ++i) sum += c[i] * y[i];
  return sum;
}

Irradiance project_irradiance(const Radiance& radiance, int samples_per_face_side) {
  const int side = samples_per_face_side;
  std::array<glm::dvec3, 9> sum{};
  for (int face = 0; face < 6; ++face) {
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        const glm::vec3 direction = cube_direction(face, side, x, y);
        const glm::dvec3 light = texel_angle(side, x, y) * glm::dvec3(radiance(direction));
        const std::array<float, 9> h = harmonics(direction);
        for (std::size_t i = 0; i < h.size(); ++i) sum[i] += light * static_cast<double>(h[i]);
      }
    }
  }
  Irradiance irradiance;
  for (std::size_t i = 0; i < sum.size(); ++i) irradiance.c[i] = kLobe[i] * glm::vec3(sum[i]);
  return irradiance;
}

}  // namespace gearshift
