// The BRDF integral of the split sum, evaluated by a quadrature designed for this integral.
//
// This work is based on:
// Brian Karis. Real Shading in Unreal Engine 4. 2013 (the split sum)
// Eric Heitz. Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs. 2014 (G2 and lambda)
// Eric Heitz. Sampling the GGX Distribution of Visible Normals. 2018 (the weight G2 / G1)
// Jonathan Dupuy, Anis Benyoub. Sampling Visible GGX Normals with Spherical Caps. 2023 (the parametrisation)
#include <algorithm>
#include <cmath>
#include <thread>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/vec3.hpp>

#include "engine/light/environment.h"

namespace gearshift::engine {

namespace {

// Gauss-Legendre quadrature on [0, 1]. The nodes are the roots of P_n, found by Newton's method from Tricomi's guess.
struct Quadrature {
  std::vector<double> node, weight;
};
Quadrature gauss_legendre(int n) {
  Quadrature q;
  for (int i = 0; i < n; ++i) {
    double z = std::cos(glm::pi<double>() * (i + 0.75) / (n + 0.5)), slope = 1.0;
    for (int step = 0; step < 8; ++step) {
      double p = 1.0, previous = 0.0;
      for (int k = 1; k <= n; ++k) {
        const double next = ((2 * k - 1) * z * p - (k - 1) * previous) / k;
        previous = p;
        p = next;
      }
      slope = n * (z * p - previous) / (z * z - 1.0);
      z -= p / slope;
    }
    q.node.push_back(0.5 * (1.0 - z));
    q.weight.push_back(1.0 / ((1.0 - z * z) * slope * slope));
  }
  return q;
}

// The visible normals of GGX seen from `view`. In the frame in which the ellipsoid of the given roughness is a sphere,
// a half vector is the sum of the view direction and a point of the spherical cap z > -view.z. The points are uniform
// in solid angle.
class VisibleNormals {
 public:
  VisibleNormals(double n_dot_v, double alpha)
      : alpha_(alpha), view_(std::sqrt(1.0 - n_dot_v * n_dot_v), 0.0, n_dot_v) {
    sphere_ = glm::normalize(glm::dvec3(alpha * view_.x, 0.0, view_.z));
    lambda_view_ = lambda(n_dot_v);
  }

  double cap_low() const { return -sphere_.z; }

  struct Reflection {
    double n_dot_l = 0.0, v_dot_h = 0.0;
  };
  // Reflection at the normal that belongs to the cap's point at height z. The azimuth is given by its cosine and sine.
  Reflection reflect(double z, double cos_phi, double sin_phi) const {
    const double ring = std::sqrt(std::max(0.0, 1.0 - z * z));
    const glm::dvec3 half = glm::normalize(
        glm::dvec3(alpha_ * (ring * cos_phi + sphere_.x), alpha_ * ring * sin_phi, std::max(1e-12, z + sphere_.z)));
    const double v_dot_h = glm::dot(view_, half);
    return {2.0 * v_dot_h * half.z - view_.z, v_dot_h};
  }

  // Lowest height on the cap at which the normal reflects the view direction to above the surface. Below this height the
  // integrand is zero. It has a kink here, so the quadrature starts here.
  double horizon(double cos_phi, double sin_phi) const {
    double low = cap_low(), high = 1.0;
    for (int i = 0; i < 20; ++i) {
      const double middle = 0.5 * (low + high);
      (reflect(middle, cos_phi, sin_phi).n_dot_l > 0.0 ? high : low) = middle;
    }
    return high;
  }

  // Returns G2 / G1, split by Schlick's Fresnel term into a part that F0 scales and a constant part.
  glm::dvec2 weight(const Reflection& r) const {
    if (r.n_dot_l <= 0.0) return glm::dvec2(0.0);
    const double shadowing = (1.0 + lambda_view_) / (1.0 + lambda_view_ + lambda(r.n_dot_l));
    const double away = 1.0 - r.v_dot_h, fresnel = away * away * away * away * away;
    return shadowing * glm::dvec2(1.0 - fresnel, fresnel);
  }

 private:
  double lambda(double cosine) const {
    const double squared = cosine * cosine;
    return 0.5 * (std::sqrt(1.0 + alpha_ * alpha_ * (1.0 - squared) / squared) - 1.0);
  }
  double alpha_;
  glm::dvec3 view_, sphere_{0.0};
  double lambda_view_ = 0.0;
};

glm::dvec2 integrate(double n_dot_v, double roughness, const Quadrature& heights, const Quadrature& azimuths) {
  const VisibleNormals normals(n_dot_v, std::max(roughness * roughness, 1e-6));
  glm::dvec2 sum(0.0);
  for (std::size_t j = 0; j < azimuths.node.size(); ++j) {  // half a turn is enough, because of symmetry
    const double phi = glm::pi<double>() * azimuths.node[j], cos_phi = std::cos(phi), sin_phi = std::sin(phi);
    const double low = normals.horizon(cos_phi, sin_phi), length = 1.0 - low;
    glm::dvec2 ring(0.0);
    for (std::size_t i = 0; i < heights.node.size(); ++i)
      ring += heights.weight[i] * normals.weight(normals.reflect(low + length * heights.node[i], cos_phi, sin_phi));
    sum += azimuths.weight[j] * length * ring;
  }
  return sum / (1.0 - normals.cap_low());
}

// Twice as many heights as azimuths, because the integrand is smoother along the azimuth.
struct Grid {
  Quadrature heights, azimuths;
};
Grid grid_of(int samples) {
  const int heights = std::max(1, static_cast<int>(std::lround(std::sqrt(2.0 * samples))));
  return {gauss_legendre(heights), gauss_legendre(std::max(1, samples / heights))};
}

std::uint16_t unorm16(double value) {
  return static_cast<std::uint16_t>(std::lround(65535.0 * std::clamp(value, 0.0, 1.0)));
}

}  // namespace

glm::dvec2 environment_brdf(double n_dot_v, double roughness, int samples) {
  const Grid grid = grid_of(samples);
  return integrate(n_dot_v, roughness, grid.heights, grid.azimuths);
}

BrdfTable bake_brdf(int side, int samples) {
  BrdfTable table;
  table.side = side;
  table.texels.resize(2 * static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  const Grid grid = grid_of(samples);
  const auto bake_rows = [&](int first, int stride) {
    for (int y = first; y < side; y += stride) {
      for (int x = 0; x < side; ++x) {
        const glm::dvec2 ab = integrate((x + 0.5) / side, (y + 0.5) / side, grid.heights, grid.azimuths);
        const std::size_t texel = 2 * static_cast<std::size_t>(y * side + x);
        table.texels[texel] = unorm16(ab.x);
        table.texels[texel + 1] = unorm16(ab.y);
      }
    }
  };
  std::thread odd_rows(bake_rows, 1, 2);
  bake_rows(0, 2);
  odd_rows.join();
  return table;
}

glm::vec2 BrdfTable::sample(float n_dot_v, float roughness) const {
  const auto texel = [&](int x, int y) {
    const int column = std::clamp(x, 0, side - 1), row = std::clamp(y, 0, side - 1);
    const std::size_t at = 2 * static_cast<std::size_t>(row * side + column);
    return glm::vec2(texels[at], texels[at + 1]) / 65535.0f;
  };
  const glm::vec2 position = glm::vec2(n_dot_v, roughness) * static_cast<float>(side) - 0.5f;
  const glm::vec2 corner = glm::floor(position), t = position - corner;
  const int x = static_cast<int>(corner.x), y = static_cast<int>(corner.y);
  return glm::mix(glm::mix(texel(x, y), texel(x + 1, y), t.x), glm::mix(texel(x, y + 1), texel(x + 1, y + 1), t.x),
                  t.y);
}

}  // namespace gearshift::engine
