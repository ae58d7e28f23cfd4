// Computes the split-sum BRDF integral with the published algorithm, as a reference for the renderer's table.
#pragma once

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace gearshift::lab {

// IntegrateBRDF (Karis 2013) on Hammersley points in double precision, with height-correlated visibility (Heitz 2014,
// eq. 99).
inline glm::dvec2 hammersley_sum(double n_dot_v, double roughness, int samples) {
  const double a2 = std::pow(roughness, 4.0);
  using glm::dvec2, glm::dvec3;
  const dvec3 view(std::sqrt(1.0 - n_dot_v * n_dot_v), 0.0, n_dot_v);
  dvec2 sum(0.0);
  for (int i = 0; i < samples; ++i) {
    double u = 0.0, digit = 0.5;
    for (int bits = i; bits != 0; bits >>= 1, digit *= 0.5) u += digit * (bits & 1);
    const double phi = 2.0 * glm::pi<double>() * (i + 0.5) / samples;
    const double n_dot_h = std::sqrt((1.0 - u) / (1.0 + (a2 - 1.0) * u)), aside = std::sqrt(1.0 - n_dot_h * n_dot_h);
    const dvec3 half(aside * std::cos(phi), aside * std::sin(phi), n_dot_h);
    const double v_dot_h = glm::dot(view, half), n_dot_l = 2.0 * v_dot_h * n_dot_h - n_dot_v;
    if (n_dot_l <= 0.0 || v_dot_h <= 0.0) continue;
    const double visibility = 0.5 / (n_dot_l * std::sqrt(n_dot_v * n_dot_v * (1.0 - a2) + a2) +
                                     n_dot_v * std::sqrt(n_dot_l * n_dot_l * (1.0 - a2) + a2));
    const double weight = 4.0 * visibility * n_dot_l * v_dot_h / n_dot_h, fresnel = std::pow(1.0 - v_dot_h, 5.0);
    sum += weight * dvec2(1.0 - fresnel, fresnel);
  }
  return sum / static_cast<double>(samples);
}

}  // namespace gearshift::lab
