#include "engine/render/brdf_fit.h"

#include <cmath>
#include <numbers>
#include <tuple>

namespace gearshift {

namespace {

constexpr int kTerms = static_cast<int>(std::tuple_size_v<BrdfFit>);
constexpr int kNodes = 32;

}  // namespace

// Chebyshev's series cut off, which is close to the best polynomial, and written in powers by T(k+1) = 2 t T(k) - T(k-1).
BrdfFit fit_brdf(const BrdfTable& table, float roughness) {
  std::array<glm::dvec2, kTerms> series{};
  for (int node = 0; node < kNodes; ++node) {
    const double angle = std::numbers::pi * (node + 0.5) / kNodes;
    const glm::dvec2 value(table.sample(static_cast<float>(0.5 + 0.5 * std::cos(angle)), roughness));
    for (int k = 0; k < kTerms; ++k)
      series[static_cast<std::size_t>(k)] += (k == 0 ? 1.0 : 2.0) / kNodes * std::cos(k * angle) * value;
  }
  std::array<double, kTerms> before{}, now{1.0};
  std::array<glm::dvec2, kTerms> powers{};
  for (std::size_t k = 0; k < series.size(); ++k) {
    for (std::size_t i = 0; i <= k; ++i) powers[i] += now[i] * series[k];
    std::array<double, kTerms> next{};
    for (std::size_t i = 0; i < next.size(); ++i)
      next[i] = (i > 0 ? (k > 0 ? 2.0 : 1.0) * now[i - 1] : 0.0) - before[i];
    before = now;
    now = next;
  }
  BrdfFit fit;
  for (std::size_t i = 0; i < fit.size(); ++i) fit[i] = glm::vec2(powers[i]);
  return fit;
}

bool has_brdf_fit(const Material& material) {
  return material.metal_rough_map.texture == kNone && material.roughness >= kLeastFittedRoughness;
}

}  // namespace gearshift
