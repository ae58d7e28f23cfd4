// The encoder of one joint, and the tangent of the joint's angle: the true one and the one read.
#pragma once

namespace gearshift::haptics {

// An angle inside an encoder cell is read as the cell's midpoint, so the error is at most half a count and unbiased.
// All consumers need the tangent of the angle. Computing it is most of a sample's cost, so the tangent of the cell is
// cached while the joint stays in the cell.
class JointEncoder {
 public:
  // counts_per_degree: at least 1, or 0 to read the angle exactly
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
