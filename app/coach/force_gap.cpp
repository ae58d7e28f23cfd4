#include "app/coach/force_gap.h"

#include <algorithm>

namespace gearshift {
namespace {

constexpr double kMostInShifts = 1.0;  // [s] [engineering value]
constexpr double kMostInAll = 3.0;     // [s] [engineering value]

// The ramp that begins with arming counts as forces: it is over in half a second.
bool has_forces(GuardState state) noexcept {
  return state == GuardState::running || state == GuardState::ramping;
}

}  // namespace

void ForceGap::add(const DriveSample& sample, bool in_shift) noexcept {
  const double dt = std::clamp(sample.time() - time_.value_or(sample.time()), 0.0, kLongestSample);
  time_ = sample.time();
  if (has_forces(sample.lever.guard)) return;
  in_all_ += dt;
  if (in_shift) in_shifts_ += dt;
}

bool ForceGap::is_long() const noexcept {
  return in_shifts_ > kMostInShifts || in_all_ > kMostInAll;
}

}  // namespace gearshift
