#include "app/lessons/report/curve_band.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace gearshift::lessons {
namespace {

glm::dvec3 slope_at(const LearningCurve& curve, double n) noexcept {
  const double trials = curve.trials.value;
  const double decay = std::exp(-n / trials);
  return {curve.at_bound ? 0.0 : 1.0, decay, curve.gain.value * decay * n / (trials * trials)};
}

}  // namespace

double curve_deviation(const LearningCurve& curve, std::size_t trials, double n) noexcept {
  glm::dmat3 information(0.0);
  // The derivative with respect to a level at its bound is 0 in every trial. So this 1 keeps the matrix invertible
  // without affecting the result.
  if (curve.at_bound) information[0][0] = 1.0;
  for (std::size_t i = 0; i < trials; ++i) {
    const glm::dvec3 slope = slope_at(curve, static_cast<double>(i));
    information += glm::outerProduct(slope, slope);
  }
  const glm::dvec3 slope = slope_at(curve, n);
  return curve.noise * std::sqrt(std::max(0.0, glm::dot(slope, glm::inverse(information) * slope)));
}

}  // namespace gearshift::lessons
