#include "haptics/hardware/stick_rig.h"

#include <algorithm>
#include <cmath>

namespace gearshift::haptics {
namespace {

constexpr std::int64_t kMaxReadingGap = 500'000'000;      // [ns] without a reading
constexpr std::int64_t kStillTime = 300'000'000;          // [ns] without motion
constexpr std::int64_t kMaxRestTime = 5'000'000'000;      // [ns] to come to rest
constexpr std::int64_t kStrictStillTime = 3'000'000'000;  // [ns] afterwards the relaxed threshold applies
constexpr double kStill = 0.0005, kRelaxedStill = 0.005;  // [1] of the range
constexpr double kMinStill = 2.0;                         // [counts]
constexpr double kMaxRunaway = 0.35;                      // [1] of the range

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

double StickRig::share(std::size_t axis) const noexcept {
  const BitField& field = driver_.lever_report().axes[axis].field;
  return (position(axis) - 0.5 * static_cast<double>(field.max + field.min)) / (0.5 * range(axis));
}

double StickRig::rest(std::size_t axis, const StickCommand& command) {
  const std::int64_t begin = step(command).now_ns;
  std::int64_t still_since = begin;
  double least = position(axis), most = least, sum = 0.0;
  for (long count = 0; latest_.now_ns - begin < kMaxRestTime; step(command)) {
    const double here = position(axis);
    const bool patient = latest_.now_ns - begin < kStrictStillTime;
    least = std::min(least, here);
    most = std::max(most, here);
    if (most - least > std::max(kMinStill, (patient ? kStill : kRelaxedStill) * range(axis))) {
      still_since = latest_.now_ns;
      least = most = here;
      sum = 0.0;
      count = 0;
    }
    sum += here;
    ++count;
    if (latest_.now_ns - still_since >= kStillTime) return sum / static_cast<double>(count);
  }
  throw CalibrationRefused("the lever does not come to rest: take your hands off it");
}

void StickRig::watch_runaway(std::size_t axis, double from) const {
  if (std::abs(position(axis) - from) > kMaxRunaway * range(axis))
    throw CalibrationRefused("the lever ran away: its motors are off");
}

}  // namespace gearshift::haptics
