#include "app/demo/feet.h"

#include <algorithm>

namespace gearshift {
namespace {

constexpr double kBefore = 0.7;      // [s] before a gear is in, the clutch is down
constexpr double kPress = 0.2;       // [s] from up to down
constexpr double kRelease = 0.25;    // [s] from down to up, once the gear is in
constexpr double kMoveOff = 0.9;     // [s] the same from standstill: the clutch slips until the car moves
constexpr double kBrakeAfter = 0.3;  // [s] in the gear before reverse: the car has to stand

// How far the clutch is down for the shift into that gear. [1]
double clutch_for(const GearTime& gear, double time) {
  const double release = gear.gear == kReverseGear ? kMoveOff : kRelease;
  const double down = std::clamp((time - (gear.time - kBefore)) / kPress, 0.0, 1.0);
  const double up = std::clamp((time - gear.time) / release, 0.0, 1.0);
  return std::min(down, 1.0 - up);
}

bool brakes_for(const GearTime& before, const GearTime& reverse, double time) {
  return time >= before.time + kBrakeAfter && time < reverse.time;
}

}  // namespace

DriverControls feet_at(double time, std::span<const GearTime> engaged) {
  DriverControls feet;
  feet.ignition = true;
  if (engaged.empty()) return feet;
  feet.clutch = time < engaged.front().time ? 1.0 : 0.0;
  feet.throttle = 0.8;
  for (std::size_t i = 0; i < engaged.size(); ++i) {
    feet.clutch = std::max(feet.clutch, clutch_for(engaged[i], time));
    if (engaged[i].gear != kReverseGear) continue;
    if (i > 0 && brakes_for(engaged[i - 1], engaged[i], time)) feet.brake = feet.clutch = 1.0;
    if (time >= engaged[i].time) feet.throttle = 0.35;
  }
  // The right foot gives way to the left one, but for moving off backwards.
  const bool backwards = engaged.back().gear == kReverseGear && time >= engaged.back().time;
  if (!backwards) feet.throttle *= 1.0 - feet.clutch;
  return feet;
}

}  // namespace gearshift
