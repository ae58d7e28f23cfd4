// An axis of powers of ten that some figures span.
#pragma once

#include <vector>

namespace gearshift {

class LogAxis {
 public:
  // What is zero or below stands at the axis' beginning, a decade below the least that is not.
  explicit LogAxis(const std::vector<double>& figures);

  double share(double figure) const noexcept;  // [1] 0 at the beginning, 1 at the end; of what is finite
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

}  // namespace gearshift
