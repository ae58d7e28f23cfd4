// Largest value of a signal over a recent time window, without storing all samples.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace gearshift::lessons {

// Divides the window into ten parts and stores, for each part, the value of largest magnitude with its sign. So the
// result covers the last 90 to 100 % of the window's length. Values that are not finite are skipped.
class RecentPeak {
 public:
  explicit RecentPeak(double window) noexcept : part_(window / kParts) {}  // [s]

  void add(double value, double dt) noexcept {
    if (!std::isfinite(value)) return;
    age_ += dt;
    if (age_ >= part_) {
      age_ = 0.0;
      newest_ = (newest_ + 1) % kParts;
      peak_[newest_] = value;
    } else if (std::abs(value) > std::abs(peak_[newest_])) {
      peak_[newest_] = value;
    }
  }

  double value() const noexcept {
    double largest = 0.0;
    for (const double peak : peak_) {
      if (std::abs(peak) > std::abs(largest)) largest = peak;
    }
    return largest;
  }

 private:
  static constexpr std::size_t kParts = 10;
  double part_;
  double age_ = 0.0;
  std::size_t newest_ = 0;
  std::array<double, kParts> peak_{};
};

}  // namespace gearshift::lessons
