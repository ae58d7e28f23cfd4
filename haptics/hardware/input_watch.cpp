#include "haptics/hardware/input_watch.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace gearshift {

InputWatch::InputWatch(const LeverReport& report, std::array<std::size_t, 2> axes) : axes_(axes) {
  for (std::size_t i = 0; i < 2; ++i) {
    const BitField& field = report.axes[axes[i]].field;
    range_[i] = static_cast<double>(field.max - field.min);
  }
}

std::array<std::int64_t, 2> InputWatch::place(const LeverCounts& counts) const noexcept {
  return {counts.axis[axes_[0]], counts.axis[axes_[1]]};
}

void InputWatch::see(const LeverCounts& counts, std::array<double, 2> force, std::int64_t time_ns) noexcept {
  const std::array<std::int64_t, 2> now = place(counts);
  watch_jump(now, time_ns);
  if (!started_ || now != place_) {
    still_since_ns_ = time_ns;
    least_ = most_ = force;
  }
  const std::int64_t passed_ns = started_ ? time_ns - time_ns_ : 0;
  started_ = true;
  place_ = now;
  time_ns_ = time_ns;
  watch_still(force, passed_ns);
}

void InputWatch::watch_jump(std::array<std::int64_t, 2> now, std::int64_t time_ns) noexcept {
  jump_ = 0.0;
  if (!started_ || static_cast<double>(time_ns - time_ns_) > 1e9 * kJumpTime) return;
  for (std::size_t i = 0; i < 2; ++i) {
    const double share = std::abs(static_cast<double>(now[i] - place_[i])) / range_[i];
    if (share > kJump) jump_ = std::max(jump_, share);
  }
}

void InputWatch::watch_still(std::array<double, 2> force, std::int64_t passed_ns) noexcept {
  double varied = 0.0, strongest = 0.0;
  for (std::size_t i = 0; i < 2; ++i) {
    least_[i] = std::min(least_[i], force[i]);
    most_[i] = std::max(most_[i], force[i]);
    varied = std::max(varied, most_[i] - least_[i]);
    strongest = std::max({strongest, -least_[i], most_[i]});
  }
  const bool still = static_cast<double>(time_ns_ - still_since_ns_) >= 1e9 * kFrozenTime;
  const double passed = 1e-9 * static_cast<double>(passed_ns);
  const double change = still && strongest > kYieldForce ? -passed / kYieldTime : passed / kReturnTime;
  share_ = std::clamp(share_ + change, 0.0, 1.0);
  frozen_ = still && varied > kFrozenForce;
}

}  // namespace gearshift
