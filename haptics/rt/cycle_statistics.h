// Timing statistics of a periodic thread: fixed-size histograms without allocation.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace gearshift::haptics {

// Log-spaced histogram of durations from 1 ns to over 10 s. Below 64 ns there is one bin per nanosecond, above 64 ns
// there are 64 bins per octave, so no bin is wider than 1/64 = 1.6 % of its durations. Not synchronised: use it from
// one thread at a time.
class DurationHistogram {
 public:
  void add(std::int64_t ns) noexcept;                 // a negative duration counts as 0. Real-time safe
  std::int64_t quantile(double q) const noexcept;     // [ns] upper edge of the quantile's bin, 0 <= q <= 1; 0 if empty
  std::int64_t max() const noexcept { return max_; }  // [ns] exact
  std::uint64_t count() const noexcept { return count_; }

 private:
  static constexpr int kSubBits = 6;  // 2^6 bins per octave
  static constexpr int kTopBit = 34;  // range up to 2^34 ns = 17.2 s; the last bin also counts longer durations
  static constexpr std::size_t kBins = std::size_t{kTopBit - kSubBits + 1} << kSubBits;

  static std::size_t bin_of(std::uint64_t ns) noexcept;
  static std::int64_t upper_edge(std::size_t bin) noexcept;

  std::array<std::uint64_t, kBins> bins_{};
  std::uint64_t count_ = 0;
  std::int64_t max_ = 0;
};

struct CycleStatistics {
  DurationHistogram wake_lateness;  // [ns] wake-up time minus deadline
  DurationHistogram duration;       // [ns] duration of the cycle's work
  std::uint64_t cycles = 0;
  std::uint64_t overruns = 0;  // number of cycles that ended after the next deadline; the missed deadlines are skipped
  std::uint64_t skipped = 0;   // number of deadlines skipped after an overrun or a wake-up late by at least a period
};

}  // namespace gearshift::haptics
