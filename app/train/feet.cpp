#include "app/train/feet.h"

#include <algorithm>

namespace gearshift {
namespace {

constexpr double kBefore = 0.7;      // [s] before a gear is in, the clutch is down
constexpr double kPress = 0.2;       // [s] from up to down
constexpr double kRelease = 0.25;    // [s] from down to up, once the gear is in
constexpr double kMoveOff = 0.9;     // [s] the same from standstill: the clutch slips until the car moves
constexpr double kThrottle = 0.8;    // [1] in a forward gear
constexpr double kBackwards = 0.35;  // [1] in reverse

constexpr double kLabours = 100.0;      // [rad/s] 950 rpm: below it the clutch gives way ...
constexpr double kNearlyStalls = 60.0;  // [rad/s] ... and is all down here
constexpr double kHelpsItOver = 0.4;    // [1] throttle meanwhile

// How far the clutch is down for the shift into that gear. [1]
double clutch_for(const GearTime& gear, double time) {
  const double release = gear.gear == kReverseGear ? kMoveOff : kRelease;
  const double down = std::clamp((time - (gear.time - kBefore)) / kPress, 0.0, 1.0);
  const double up = std::clamp((time - gear.time) / release, 0.0, 1.0);
  return std::min(down, 1.0 - up);
}

// From where the gear before it begins: the car has to stand when reverse comes.
bool brakes_for(const GearTime& before, const GearTime& reverse, double time) {
  return time >= before.time - kBefore && time < reverse.time;
}

// The right foot gives way to the left one, but for moving off backwards.
double throttle_in(int gear, double clutch) {
  if (gear == kNeutralGear) return 0.0;
  return gear == kReverseGear ? kBackwards : kThrottle * (1.0 - clutch);
}

}  // namespace

DriverControls feet_at(double time, std::span<const GearTime> engaged, const VehicleState& car) {
  DriverControls feet;
  feet.ignition = true;
  if (engaged.empty()) return feet;
  feet.clutch = time < engaged.front().time ? 1.0 : 0.0;
  int gear = kNeutralGear;
  for (std::size_t i = 0; i < engaged.size(); ++i) {
    feet.clutch = std::max(feet.clutch, clutch_for(engaged[i], time));
    if (time >= engaged[i].time) gear = engaged[i].gear;
    if (engaged[i].gear == kReverseGear && i > 0 && brakes_for(engaged[i - 1], engaged[i], time))
      feet.brake = feet.clutch = 1.0;
  }
  feet.throttle = throttle_in(gear, feet.clutch);
  const double labours = std::clamp((kLabours - car.engine_speed) / (kLabours - kNearlyStalls), 0.0, 1.0);
  if (gear == kNeutralGear || feet.clutch == 1.0 || labours == 0.0) return feet;
  feet.clutch = std::max(feet.clutch, labours);
  feet.throttle = std::max(feet.throttle, kHelpsItOver);
  return feet;
}

}  // namespace gearshift
