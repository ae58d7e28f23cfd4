// A logarithmic plot axis that spans the given values.
#pragma once

#include <vector>

namespace gearshift::lab {

class LogAxis {
 public:
  // Values <= 0 are placed at the start of the axis, at least a decade below the smallest positive value.
  explicit LogAxis(const std::vector<double>& figures);

  double fraction(double figure) const noexcept;  // [1] position: 0 at the start, 1 at the end; figure must be finite
  struct Tick {
    double value = 0.0;
    bool named = true;
  };
  const std::vector<Tick>& ticks() const noexcept { return ticks_; }
  bool begins_with_zero() const noexcept { return zero_; }

 private:
  double low_ = 0.0, high_ = 1.0;  // log10
  bool zero_ = false;
  std::vector<Tick> ticks_;
};

}  // namespace gearshift::lab
