#include "app/vehicle/shift_advice.h"

namespace gearshift::vehicle {
namespace {

// Engine speed in `gear` at the current road speed, computed from the engine speed in the current gear. 0 if there is
// no such gear.
double engine_speed_in(const CarSpec& car, const VehicleState& now, int gear) noexcept {
  const double other = gear >= 1 ? shaft_per_road(car, gear) : 0.0;
  return other / shaft_per_road(car, now.gear) * now.engine_speed;
}

bool advises_up(const CarSpec& car, const VehicleState& now, bool lit) noexcept {
  const double band = lit ? 1.0 - kAdviceHysteresis : 1.0;
  return now.engine_speed > band * car.engine.shift_high &&
         now.pedals.throttle > (lit ? kUpshiftThrottleOff : kUpshiftThrottle) &&
         engine_speed_in(car, now, now.gear + 1) >= band * car.engine.lug_below;
}

bool advises_down(const CarSpec& car, const VehicleState& now, bool lit) noexcept {
  const double band = lit ? 1.0 + kAdviceHysteresis : 1.0;
  return now.engine_speed < band * car.engine.lug_below &&
         now.engine_load > (lit ? kDownshiftLoadOff : kDownshiftLoad) && now.gear > 1 &&
         engine_speed_in(car, now, now.gear - 1) < car.engine.red_line;
}

}  // namespace

int shift_advice(const CarSpec& car, const VehicleState& now, int before) noexcept {
  if (now.gear < 1 || shaft_per_road(car, now.gear) == 0.0 || !now.running || !now.clutch_locked) return 0;
  if (advises_up(car, now, before > 0)) return 1;
  return advises_down(car, now, before < 0) ? -1 : 0;
}

}  // namespace gearshift::vehicle
