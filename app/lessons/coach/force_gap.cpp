#include "app/lessons/coach/force_gap.h"

#include <algorithm>

namespace gearshift::lessons {
namespace {

constexpr double kMaxGapInShifts = 1.0;  // [s] engineering value
constexpr double kMaxGap = 3.0;          // [s] engineering value

// The ramp after arming counts as having forces, because it takes only half a second.
bool has_forces(haptics::GuardState state) noexcept {
  return state == haptics::GuardState::running || state == haptics::GuardState::ramping;
}

}  // namespace

void ForceGap::add(const vehicle::DriveSample& sample, bool in_shift) noexcept {
  const double dt = std::clamp(sample.time() - time_.value_or(sample.time()), 0.0, vehicle::kMaxSampleInterval);
  time_ = sample.time();
  if (has_forces(sample.lever.guard)) return;
  in_all_ += dt;
  if (in_shift) in_shifts_ += dt;
}

bool ForceGap::is_long() const noexcept {
  return in_shifts_ > kMaxGapInShifts || in_all_ > kMaxGap;
}

}  // namespace gearshift::lessons
