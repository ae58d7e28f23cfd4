#include "app/ui/panel/clip_record.h"

#include <algorithm>
#include <cmath>

namespace gearshift::ui {

void ClipRecord::push(double time, double wanted, bool clipped) noexcept {
  if (!std::isfinite(time) || !std::isfinite(wanted)) return;
  const auto here = static_cast<std::int64_t>(std::floor(time * kBins / kSpan));
  if (empty_ || here < newest_) {
    bins_.fill({});
    newest_ = here;
    empty_ = false;
  }
  const auto bin = [this](std::int64_t place) -> Bin& {
    return bins_[static_cast<std::size_t>((place % kBins + kBins) % kBins)];
  };
  for (std::int64_t i = std::max(newest_ + 1, here - kBins + 1); i <= here; ++i) bin(i) = {};
  newest_ = here;
  Bin& now = bin(here);
  ++now.samples;
  now.clipped += clipped ? 1u : 0u;
  now.peak = std::max(now.peak, std::abs(wanted));
}

double ClipRecord::fraction() const noexcept {
  std::uint64_t samples = 0, clipped = 0;
  for (const Bin& bin : bins_) {
    samples += bin.samples;
    clipped += bin.clipped;
  }
  return samples == 0 ? 0.0 : static_cast<double>(clipped) / static_cast<double>(samples);
}

double ClipRecord::peak() const noexcept {
  double peak = 0.0;
  for (const Bin& bin : bins_) peak = std::max(peak, bin.peak);
  return peak;
}

}  // namespace gearshift::ui
