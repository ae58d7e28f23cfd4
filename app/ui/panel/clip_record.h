// Fraction of the last ten seconds in which the device clipped the force.
#pragma once

#include <array>
#include <cstdint>

namespace gearshift::ui {

class ClipRecord {
 public:
  static constexpr double kSpan = 10.0;  // [s]
  static constexpr int kBins = 100;

  // time [s] must not decrease within a run; a smaller time starts a new run. wanted [N]: the larger axis component.
  void push(double time, double wanted, bool clipped) noexcept;

  double fraction() const noexcept;  // [1] fraction of the samples within the span that were clipped
  double peak() const noexcept;      // [N] largest wanted force within the span

 private:
  struct Bin {
    std::uint32_t samples = 0, clipped = 0;
    double peak = 0.0;  // [N]
  };
  std::array<Bin, kBins> bins_{};  // ring buffer indexed by time
  std::int64_t newest_ = 0;        // [bins] time of the newest sample since time 0
  bool empty_ = true;
};

}  // namespace gearshift::ui
