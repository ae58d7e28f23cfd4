// Fraction of the last ten seconds in which the device clipped the force.
#pragma once

#include <array>
#include <cstdint>

namespace gearshift::ui {

class ClipRecord {
 public:
  static constexpr double kSpan = 10.0;  // [s]
  static constexpr int kBins = 100;

  // `time` [s]: if smaller than the previous time, a new run starts. `wanted` [N]: the larger component of the rendered
  // force.
  void push(double time, double wanted, bool clipped) noexcept;

  double fraction() const noexcept;  // [1] fraction of the samples in the last kSpan that were clipped
  double peak() const noexcept;      // [N] largest `wanted` in the last kSpan

 private:
  struct Bin {
    std::uint32_t samples = 0, clipped = 0;
    double peak = 0.0;  // [N]
  };
  std::array<Bin, kBins> bins_{};  // ring buffer indexed by time
  std::int64_t newest_ = 0;        // [bins] time of the newest sample, counted in bins from time 0
  bool empty_ = true;
};

}  // namespace gearshift::ui
