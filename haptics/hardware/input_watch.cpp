#include "haptics/hardware/input_watch.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace gearshift::haptics {

InputWatch::InputWatch(const LeverReport& report, std::array<std::size_t, 2> axes) : axes_(axes) {
  for (std::size_t i = 0; i < 2; ++i) {
    const BitField& field = report.axes[axes[i]].field;
    axis_[i].middle = 0.5 * static_cast<double>(field.min + field.max);
    axis_[i].half_range = 0.5 * static_cast<double>(field.max - field.min);
  }
}

void InputWatch::update(const LeverCounts& counts, std::array<double, 2> force, std::array<PidSpring, 2> springs,
                        std::int64_t time_ns) noexcept {
  const double since = started_ ? 1e-9 * static_cast<double>(time_ns - time_ns_) : 0.0;
  const double passed = std::min(since, kMaxReportGap);
  if (since > kMaxReportGap) unsure_ns_ = time_ns + static_cast<std::int64_t>(1e9 * kMaxJumpTime);
  watch_jump(counts, time_ns);
  for (std::size_t i = 0; i < 2; ++i) {
    const std::int64_t place = counts.axis[axes_[i]];
    const double deflection = (static_cast<double>(place) - axis_[i].middle) / axis_[i].half_range;
    const bool is_beyond = std::abs(deflection - springs[i].centre) > springs[i].dead_band;
    watch_still(axis_[i], place, force[i], is_beyond ? springs[i].coefficient : 0.0, passed);
  }
  started_ = true;
  time_ns_ = time_ns;
}

void InputWatch::reset_force() noexcept {
  for (Axis& axis : axis_) {
    axis.forced_time = 0.0;
    axis.force_fraction = 1.0;
  }
}

void InputWatch::watch_jump(const LeverCounts& counts, std::int64_t time_ns) noexcept {
  jump_ = 0.0;
  const bool are_neighbours = started_ && static_cast<double>(time_ns - time_ns_) <= 1e9 * kMaxJumpTime;
  if (!are_neighbours || time_ns < unsure_ns_) return;
  for (std::size_t i = 0; i < 2; ++i) {
    const auto moved = static_cast<double>(counts.axis[axes_[i]] - axis_[i].place);
    const double fraction = 0.5 * std::abs(moved) / axis_[i].half_range;
    if (fraction > kMinJump) jump_ = std::max(jump_, fraction);
  }
}

void InputWatch::watch_still(Axis& axis, std::int64_t place, double force, double spring, double passed) noexcept {
  const bool moved = place != axis.place;
  axis.place = place;
  if (moved) {
    axis.forced_time = 0.0;
    axis.force.begin(force);
    axis.spring.begin(spring);
  }
  axis.force.add(force);
  axis.spring.add(spring);
  const bool is_pushed = std::max(std::abs(force), std::abs(spring)) > kMinPushForce;
  // Once forced_time has reached kFrozenTime, it stays constant until the axis moves; meanwhile the force fades out.
  const bool was_still = axis.forced_time >= kFrozenTime;
  if (!was_still) axis.forced_time = std::max(0.0, axis.forced_time + (is_pushed ? passed : -kStillnessDecay * passed));
  const bool is_still = axis.forced_time >= kFrozenTime;
  const double change = is_still ? -passed / kFadeOutTime : passed / kFadeInTime;
  axis.force_fraction = std::clamp(axis.force_fraction + change, 0.0, 1.0);
  axis.frozen = is_still && std::max(axis.force.width(), axis.spring.width()) > kFrozenForce;
}

void InputWatch::Span::add(double value) noexcept {
  min = std::min(min, value);
  max = std::max(max, value);
}

}  // namespace gearshift::haptics
