#include "app/vehicle/keyboard_pedals.h"

#include <algorithm>
#include <cmath>

namespace gearshift::vehicle {
namespace {

constexpr double kLightThrottle = 0.2;  // [1] fraction of full throttle; enough to move off
constexpr double kFreeSpeed = 180.0;    // [rad/s] about 1700 rpm; an uncoupled engine gets no light throttle above this
constexpr double kFreeBand = 50.0;      // [rad/s] range below kFreeSpeed in which light throttle falls to 0

// Returns the light throttle [1]. While the engine is not coupled to the wheels, the throttle falls to 0 as the engine
// speed approaches kFreeSpeed. A constant kLightThrottle would over-rev the engine.
double light_throttle(double engine_speed, bool coupled) noexcept {
  if (coupled) return kLightThrottle;
  return kLightThrottle * std::clamp((kFreeSpeed - engine_speed) / kFreeBand, 0.0, 1.0);
}

// Returns the pedal position after `seconds` of motion towards `to`. `time`: duration of the full travel [s].
double ramped(double pedal, double to, double seconds, double time) noexcept {
  const double step = seconds / time;
  return std::clamp(to, pedal - step, pedal + step);
}

// Returns the position of the released clutch pedal after `seconds`: the pedal rises fast, but slowly from clutch_bite
// to clutch_closed.
double release_clutch(double pedal, double seconds, const PedalTiming& pace) noexcept {
  const double edges[] = {pace.clutch_bite, pace.clutch_closed, 0.0};
  const double quick = 1.0 / pace.pedal_time, slow = (pace.clutch_bite - pace.clutch_closed) / pace.slip_time;
  const double speeds[] = {quick, slow, quick};
  for (int part = 0; part < 3; ++part) {
    const double step = std::min(std::max(pedal - edges[part], 0.0), speeds[part] * seconds);
    pedal -= step;
    seconds -= step / speeds[part];
  }
  return pedal;
}

}  // namespace

const haptics::Pedals& KeyboardPedals::move(const PedalKeys& keys, const PedalTiming& timing, double seconds,
                                            double engine_speed, bool coupled) noexcept {
  seconds = std::isfinite(seconds) ? std::max(seconds, 0.0) : 0.0;
  const double time = timing.pedal_time;
  const double light = keys.throttle_light ? light_throttle(engine_speed, coupled) : 0.0;
  pedals_.throttle = ramped(pedals_.throttle, keys.throttle ? 1.0 : light, seconds, time);
  pedals_.brake = ramped(pedals_.brake, keys.brake ? 1.0 : 0.0, seconds, time);
  if (keys.clutch)
    pedals_.clutch = ramped(pedals_.clutch, 1.0, seconds, time);
  else if (!keys.clutch_hold)
    pedals_.clutch = release_clutch(pedals_.clutch, seconds, timing);
  return pedals_;
}

}  // namespace gearshift::vehicle
