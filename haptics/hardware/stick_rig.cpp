#include "haptics/hardware/stick_rig.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace gearshift::haptics {
namespace {

constexpr std::int64_t kMaxReadingGap = 500'000'000;      // [ns] longest time without a reading
constexpr std::int64_t kStillTime = 300'000'000;          // [ns] required time without motion
constexpr std::int64_t kMaxRestTime = 5'000'000'000;      // [ns] longest time to come to rest
constexpr std::int64_t kStrictStillTime = 3'000'000'000;  // [ns] after this time kRelaxedStill applies
constexpr double kStill = 0.0005, kRelaxedStill = 0.005;  // [1] largest motion when still, fraction of the axis's range
constexpr double kMinStill = 2.0;                         // [counts]
constexpr double kMaxRunaway = 0.35;                      // [1] fraction of the axis's range

}  // namespace

StickRig::StickRig(PidDriver& driver, const CalibrationTick& tick)
    : driver_(driver), tick_(tick), session_(driver.state().session) {
  if (session_ == 0) throw CalibrationRefused("the stick is not connected");
}

const StickRig::Tick& StickRig::step(const StickCommand& command) {
  latest_.now_ns = tick_();
  const StickState state = driver_.state();
  if (state.session != session_) throw CalibrationRefused("the stick was disconnected during the measurement");
  latest_.fresh = state.sequence != latest_.state.sequence;
  if (latest_.fresh || !has_reading_) last_reading_ns_ = latest_.now_ns;
  has_reading_ = true;
  latest_.state = state;
  if (latest_.now_ns - last_reading_ns_ > kMaxReadingGap) throw CalibrationRefused("the stick sends no position");
  driver_.command(command);
  return latest_;
}

double StickRig::range(std::size_t axis) const noexcept {
  const BitField& field = driver_.lever_report().axes[axis].field;
  return static_cast<double>(field.max - field.min);
}

double StickRig::deflection(std::size_t axis) const noexcept {
  const BitField& field = driver_.lever_report().axes[axis].field;
  return (position(axis) - 0.5 * static_cast<double>(field.max + field.min)) / (0.5 * range(axis));
}

double StickRig::rest(std::size_t axis, const StickCommand& command, std::size_t also) {
  const std::array axes{axis, also};
  const std::int64_t begin = step(command).now_ns;
  std::int64_t still_since = begin;
  std::array<double, 2> lowest{position(axis), position(also)}, highest = lowest;
  double sum = 0.0;
  for (long count = 0; latest_.now_ns - begin < kMaxRestTime; step(command)) {
    const double still = latest_.now_ns - begin < kStrictStillTime ? kStill : kRelaxedStill;
    bool moves = false;
    for (std::size_t i = 0; i < 2; ++i) {
      lowest[i] = std::min(lowest[i], position(axes[i]));
      highest[i] = std::max(highest[i], position(axes[i]));
      moves = moves || highest[i] - lowest[i] > std::max(kMinStill, still * range(axes[i]));
    }
    if (moves) {
      still_since = latest_.now_ns;
      lowest = highest = {position(axis), position(also)};
      sum = 0.0;
      count = 0;
    }
    sum += position(axis);
    ++count;
    if (latest_.now_ns - still_since >= kStillTime) return sum / static_cast<double>(count);
  }
  throw CalibrationRefused("the lever does not come to rest. Take your hands off the lever");
}

void StickRig::watch_runaway(std::size_t axis, double from) const {
  if (std::abs(position(axis) - from) > kMaxRunaway * range(axis))
    throw Runaway("the lever moved too far, so its motors were switched off");
}

}  // namespace gearshift::haptics
