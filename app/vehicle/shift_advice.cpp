#include "app/vehicle/shift_advice.h"

namespace gearshift {
namespace {

// Engine's speed in another gear at this road speed, by that in the gear which is in. 0: there is none.
double speed_in(const CarSpec& car, const VehicleState& now, int gear) noexcept {
  const double other = gear >= 1 ? shaft_per_road(car, gear) : 0.0;
  return other / shaft_per_road(car, now.gear) * now.engine_speed;
}

bool goes_up(const CarSpec& car, const VehicleState& now, bool lit) noexcept {
  const double band = lit ? 1.0 - kAdviceBand : 1.0;
  return now.engine_speed > band * car.engine.shift_high && now.throttle > (lit ? kNoLongerPulls : kPulls) &&
         speed_in(car, now, now.gear + 1) >= band * car.engine.lug_below;
}

bool goes_down(const CarSpec& car, const VehicleState& now, bool lit) noexcept {
  const double band = lit ? 1.0 + kAdviceBand : 1.0;
  return now.engine_speed < band * car.engine.lug_below && now.engine_load > (lit ? kNoLongerLabours : kLabours) &&
         now.gear > 1 && speed_in(car, now, now.gear - 1) < car.engine.red_line;
}

}  // namespace

int shift_advice(const CarSpec& car, const VehicleState& now, int before) noexcept {
  if (now.gear < 1 || shaft_per_road(car, now.gear) == 0.0 || !now.running || !now.clutch_locked) return 0;
  if (goes_up(car, now, before > 0)) return 1;
  return goes_down(car, now, before < 0) ? -1 : 0;
}

}  // namespace gearshift
