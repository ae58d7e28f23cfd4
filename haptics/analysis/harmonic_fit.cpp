#include "haptics/analysis/harmonic_fit.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace gearshift::haptics {

void HarmonicFit::begin(double omega, double start, double length) noexcept {
  *this = {};
  omega_ = omega;
  start_ = start;
  length_ = length;
}

void HarmonicFit::add(double time, glm::dvec3 values) noexcept {
  const double t = time - start_;
  const glm::dvec4 basis{std::cos(omega_ * t), std::sin(omega_ * t), 1.0, 2.0 * t / length_ - 1.0};
  normal_ += glm::outerProduct(basis, basis);
  projected_ += glm::outerProduct(basis, values);
  squares_ += values * values;
  ++samples_;
}

HarmonicFit::Phasor HarmonicFit::phasor(int i) const noexcept {
  const glm::dmat4 inverse = glm::inverse(normal_);
  const glm::dvec4 projected = projected_[i], weight = inverse * projected;
  const double variance = std::max(0.0, squares_[i] - glm::dot(weight, projected)) / (samples_ - 4);
  return {{weight[0], -weight[1]}, std::sqrt(variance * 0.5 * (inverse[0][0] + inverse[1][1]))};
}

}  // namespace gearshift::haptics
