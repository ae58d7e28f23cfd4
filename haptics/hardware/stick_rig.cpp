#include "haptics/hardware/stick_rig.h"

#include <algorithm>
#include <cmath>

namespace gearshift {
namespace {

constexpr std::int64_t kSilent = 500'000'000;         // [ns] without a reading
constexpr std::int64_t kStillTime = 300'000'000;      // [ns] in one place
constexpr std::int64_t kLongestRest = 5'000'000'000;  // [ns] for it to stand still,
constexpr std::int64_t kPatience = 3'000'000'000;     // [ns] and then a little restlessness will do
constexpr double kStill = 0.0005, kRestless = 0.005;  // [1] of the range
constexpr double kLeastStill = 2.0;                   // [counts]
constexpr double kFarthest = 0.35;                    // [1] of the range

}  // namespace

StickRig::StickRig(PidDriver& driver, const CalibrationTick& tick)
    : driver_(driver), tick_(tick), session_(driver.see().session) {
  if (session_ == 0) throw CalibrationRefused("the stick is not connected");
}

const StickRig::Look& StickRig::step(const PidWish& wish) {
  look_.now_ns = tick_();
  const PidSight sight = driver_.see();
  if (sight.session != session_) throw CalibrationRefused("the stick was lost while it was measured");
  look_.fresh = sight.sequence != look_.sight.sequence;
  if (look_.fresh || !heard_) heard_ns_ = look_.now_ns;
  heard_ = true;
  look_.sight = sight;
  if (look_.now_ns - heard_ns_ > kSilent) throw CalibrationRefused("the stick says nothing of its place");
  driver_.wish(wish);
  return look_;
}

double StickRig::range(std::size_t axis) const noexcept {
  const BitField& field = driver_.lever_report().axes[axis].field;
  return static_cast<double>(field.max - field.min);
}

double StickRig::share(std::size_t axis) const noexcept {
  const BitField& field = driver_.lever_report().axes[axis].field;
  return (position(axis) - 0.5 * static_cast<double>(field.max + field.min)) / (0.5 * range(axis));
}

double StickRig::rest(std::size_t axis, const PidWish& wish) {
  const std::int64_t begin = step(wish).now_ns;
  std::int64_t still_since = begin;
  double least = position(axis), most = least, sum = 0.0;
  for (long count = 0; look_.now_ns - begin < kLongestRest; step(wish)) {
    const double here = position(axis);
    const bool patient = look_.now_ns - begin < kPatience;
    least = std::min(least, here);
    most = std::max(most, here);
    if (most - least > std::max(kLeastStill, (patient ? kStill : kRestless) * range(axis))) {
      still_since = look_.now_ns;
      least = most = here;
      sum = 0.0;
      count = 0;
    }
    sum += here;
    ++count;
    if (look_.now_ns - still_since >= kStillTime) return sum / static_cast<double>(count);
  }
  throw CalibrationRefused("the lever does not come to rest: take the hands off it");
}

void StickRig::watch_runaway(std::size_t axis, double from) const {
  if (std::abs(position(axis) - from) > kFarthest * range(axis))
    throw CalibrationRefused("the lever ran away from where it was: its motors are off");
}

}  // namespace gearshift
