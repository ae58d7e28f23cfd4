// This work is based on:
// Gil Tene. HdrHistogram: A High Dynamic Range Histogram. 2012 (linear bins inside octaves)
#include "haptics/rt/cycle_statistics.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace gearshift::haptics {

// The leading bit of `ns` selects the octave, and the next kSubBits bits select the bin inside the octave.
std::size_t DurationHistogram::bin_of(std::uint64_t ns) noexcept {
  if (ns < (1u << kSubBits)) return static_cast<std::size_t>(ns);
  const int octave = static_cast<int>(std::bit_width(ns)) - 1 - kSubBits;
  const std::uint64_t bin = (static_cast<std::uint64_t>(octave) << kSubBits) + (ns >> octave);
  return std::min<std::size_t>(static_cast<std::size_t>(bin), kBins - 1);
}

// Longest duration [ns] that falls into the bin.
std::int64_t DurationHistogram::upper_edge(std::size_t bin) noexcept {
  if (bin < (2u << kSubBits)) return static_cast<std::int64_t>(bin);
  const std::size_t octave = (bin >> kSubBits) - 1;
  const std::size_t leading = bin - (octave << kSubBits);
  return static_cast<std::int64_t>(((leading + 1) << octave) - 1);
}

void DurationHistogram::add(std::int64_t ns) noexcept {
  ns = std::max<std::int64_t>(ns, 0);
  ++bins_[bin_of(static_cast<std::uint64_t>(ns))];
  ++count_;
  max_ = std::max(max_, ns);
}

std::int64_t DurationHistogram::quantile(double q) const noexcept {
  if (count_ == 0) return 0;
  if (!(q < 1.0)) return max_;
  // The quantile is the sample of rank ceil(q * count), counted from the shortest duration.
  const double wanted = std::ceil(std::max(q, 0.0) * static_cast<double>(count_));
  const std::uint64_t rank = std::max<std::uint64_t>(static_cast<std::uint64_t>(wanted), 1);
  std::uint64_t counted = 0;
  for (std::size_t bin = 0; bin + 1 < kBins; ++bin) {
    counted += bins_[bin];
    if (counted >= rank) return std::min(upper_edge(bin), max_);
  }
  return max_;  // the last bin has no upper edge
}

}  // namespace gearshift::haptics
