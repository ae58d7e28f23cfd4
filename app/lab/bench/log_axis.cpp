#include "app/lab/bench/log_axis.h"

#include <algorithm>
#include <cmath>

namespace gearshift::lab {
namespace {

constexpr double kMargin = 0.06;     // [1] margin at each end, as a fraction of the span
constexpr double kMinSpan = 0.6;     // [decades]
constexpr double kFewDecades = 2.5;  // [decades] axes with at most this span also have labelled ticks at 2 and 5
constexpr int kMaxNamedTicks = 7;

std::vector<LogAxis::Tick> ticks_within(double low, double high) {
  std::vector<LogAxis::Tick> ticks;
  const int each = std::max(1, static_cast<int>(std::ceil((high - low) / kMaxNamedTicks)));
  for (int power = static_cast<int>(std::floor(low)); power <= static_cast<int>(std::ceil(high)); ++power) {
    for (const double step : {1.0, 2.0, 5.0}) {
      const double value = step * std::pow(10.0, power);
      const bool few = high - low <= kFewDecades;
      if (std::log10(value) < low || std::log10(value) > high || (step > 1.0 && !few)) continue;
      ticks.push_back({value, few || power % each == 0});
    }
  }
  return ticks;
}

}  // namespace

LogAxis::LogAxis(const std::vector<double>& figures) {
  double low = INFINITY, high = -INFINITY;
  for (const double figure : figures) {
    if (!std::isfinite(figure)) continue;
    if (figure <= 0.0) {
      zero_ = true;
      continue;
    }
    low = std::min(low, std::log10(figure));
    high = std::max(high, std::log10(figure));
  }
  if (low > high) low = high = 0.0;
  const double span = std::max(kMinSpan, high - low), middle = 0.5 * (low + high);
  low_ = middle - (0.5 + kMargin) * span;
  high_ = middle + (0.5 + kMargin) * span;
  ticks_ = ticks_within(low_, high_);
  if (zero_) low_ -= 1.0;
}

double LogAxis::fraction(double figure) const noexcept {
  return figure > 0.0 ? (std::log10(figure) - low_) / (high_ - low_) : 0.0;
}

}  // namespace gearshift::lab
