// The encoder of one joint. Provides the tangent of the joint's true angle and of the angle that the encoder reads.
#pragma once

namespace gearshift::haptics {

// The encoder reads every angle inside one of its cells as the cell's midpoint. So the error has a mean of zero and is
// at most half a count. The class provides tangents, because callers need only these. Computing a tangent takes most of
// the time of a sample, so it is cached while the joint stays in the same cell.
class JointEncoder {
 public:
  // `counts_per_degree`: at least 1, or 0 for an encoder without quantisation.
  explicit JointEncoder(double counts_per_degree) noexcept;

  void read(double angle) noexcept;  // [rad]

  double true_tangent() const noexcept { return true_tangent_; }
  double read_tangent() const noexcept { return read_tangent_; }

 private:
  double counts_per_radian_;
  double radians_per_count_;
  double cell_;  // [counts] cell of the last reading
  double true_tangent_ = 0.0;
  double read_tangent_ = 0.0;
};

}  // namespace gearshift::haptics
