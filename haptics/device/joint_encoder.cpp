#include "haptics/device/joint_encoder.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace gearshift::haptics {
namespace {

// Taylor series for angles up to half a degree, where its next term is below 1e-18.
double tangent_of_small(double x) noexcept {
  const double x2 = x * x;
  return x * (1.0 + x2 * (1.0 / 3.0 + x2 * (2.0 / 15.0 + x2 * (17.0 / 315.0))));
}

}  // namespace

JointEncoder::JointEncoder(double counts_per_degree) noexcept
    : counts_per_radian_(counts_per_degree * 180.0 / std::numbers::pi),
      radians_per_count_(counts_per_radian_ > 0.0 ? 1.0 / counts_per_radian_ : 0.0),
      cell_(std::numeric_limits<double>::quiet_NaN()) {}

void JointEncoder::read(double angle) noexcept {
  if (counts_per_radian_ == 0.0) {
    true_tangent_ = read_tangent_ = std::tan(angle);
    return;
  }
  const double cell = std::floor(angle * counts_per_radian_);
  const double middle = (cell + 0.5) * radians_per_count_;
  if (cell != cell_) read_tangent_ = std::tan(middle);
  cell_ = cell;

  // The tangent of `angle`, by the addition theorem from the tangents of `middle` (read_tangent_) and of the rest
  // (`offset`). This is exact, and much faster than a second call of std::tan.
  const double offset = tangent_of_small(angle - middle);
  true_tangent_ = (read_tangent_ + offset) / (1.0 - read_tangent_ * offset);
}

}  // namespace gearshift::haptics
