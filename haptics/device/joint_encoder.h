// The encoder of one joint, and the joint's tangent: true and as read.
#pragma once

namespace gearshift {

// A joint at some angle inside an encoder cell is read at the cell's midpoint, so that the error is half a
// count at most and without bias. Everything downstream wants the tangent of the angle; computing it is most
// of what a sample costs, so the tangent of the cell is kept while the joint stays in it.
class JointEncoder {
 public:
  // counts per degree, at least 1; 0 reads the angle exactly
  explicit JointEncoder(double counts_per_degree) noexcept;

  void read(double angle) noexcept;  // [rad]

  double true_tangent() const noexcept { return true_tangent_; }
  double read_tangent() const noexcept { return read_tangent_; }

 private:
  double counts_per_radian_;
  double radians_per_count_;
  double cell_;  // [counts] where the joint was last
  double true_tangent_ = 0.0;
  double read_tangent_ = 0.0;
};

}  // namespace gearshift
