#include "app/input/key_feet.h"

#include <algorithm>
#include <cmath>

namespace gearshift {
namespace {

constexpr double kLightThrottle = 0.2;  // [1] what moves a car off
constexpr double kFreeSpeed = 180.0;    // [rad/s] 1700 rpm: light throttle holds a free engine below this ...
constexpr double kFreeBand = 50.0;      // [rad/s] ... and is whole this much lower

// A foot holds the revs of an engine that turns freely: a fifth of the throttle would make it howl.
double light_throttle(double engine_speed, bool coupled) {
  if (coupled) return kLightThrottle;
  return kLightThrottle * std::clamp((kFreeSpeed - engine_speed) / kFreeBand, 0.0, 1.0);
}

// Towards there, as fast as the whole way in `time`.
double ramped(double pedal, double to, double seconds, double time) {
  const double step = seconds / time;
  return std::clamp(to, pedal - step, pedal + step);
}

// A pedal let up for so long: quickly, but slowly from bite to closed.
double let_up(double pedal, double seconds, const FootPace& pace) {
  const double edges[] = {pace.clutch_bite, pace.clutch_closed, 0.0};
  const double quick = 1.0 / pace.pedal_time, slow = (pace.clutch_bite - pace.clutch_closed) / pace.slip_time;
  const double speeds[] = {quick, slow, quick};
  for (int part = 0; part < 3; ++part) {
    const double way = std::min(std::max(pedal - edges[part], 0.0), speeds[part] * seconds);
    pedal -= way;
    seconds -= way / speeds[part];
  }
  return pedal;
}

}  // namespace

void KeyFeet::ask(const FootKeys& keys) {
  const std::lock_guard lock(mutex_);
  keys_ = keys;
}

void KeyFeet::set_pace(const FootPace& pace) {
  const std::lock_guard lock(mutex_);
  pace_ = pace;
}

void KeyFeet::give_to(int lever) {
  const std::lock_guard lock(mutex_);
  lever_ = lever;
}

Pedals KeyFeet::move(double seconds, double engine_speed, bool coupled, int lever) {
  const std::lock_guard lock(mutex_);
  if (lever != lever_) return pedals_;
  seconds = std::isfinite(seconds) ? std::max(seconds, 0.0) : 0.0;
  const double time = pace_.pedal_time;
  const double light = keys_.throttle_light ? light_throttle(engine_speed, coupled) : 0.0;
  pedals_.throttle = ramped(pedals_.throttle, keys_.throttle ? 1.0 : light, seconds, time);
  pedals_.brake = ramped(pedals_.brake, keys_.brake ? 1.0 : 0.0, seconds, time);
  if (keys_.clutch)
    pedals_.clutch = ramped(pedals_.clutch, 1.0, seconds, time);
  else if (!keys_.clutch_hold)
    pedals_.clutch = let_up(pedals_.clutch, seconds, pace_);
  return pedals_;
}

}  // namespace gearshift
