// How much of the last ten seconds the device could not give what was wanted.
#pragma once

#include <array>
#include <cstdint>

namespace gearshift {

class ClipRecord {
 public:
  static constexpr double kSpan = 10.0;  // [s]
  static constexpr int kBins = 100;

  // In order of time [s]; wanted [N] along the axis of its greatest part. A time before the last one is another run.
  void push(double time, double wanted, bool clipped) noexcept;

  double share() const noexcept;  // [1] of the samples of the span
  double peak() const noexcept;   // [N] greatest wanted force of the span

 private:
  struct Bin {
    std::uint32_t samples = 0, clipped = 0;
    double peak = 0.0;  // [N]
  };
  std::array<Bin, kBins> bins_{};  // ring by place
  std::int64_t newest_ = 0;        // [bins] since time 0
  bool empty_ = true;
};

}  // namespace gearshift
