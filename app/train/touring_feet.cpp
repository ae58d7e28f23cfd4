#include "app/train/touring_feet.h"

#include <algorithm>
#include <cmath>

#include "app/train/feet.h"
#include "app/trainer/touring_hand.h"
#include "haptics/gate/gate_feel.h"
#include "haptics/loop/shift_script.h"

namespace gearshift {
namespace {

constexpr double kAnyPeriod = 1e-3;  // [s] a lap does not depend on it

}  // namespace

TouringFeet::TouringFeet(const Gate& gate) : lap_(TouringHand(gate, 1, kAnyPeriod).lap()) {
  std::vector<int> order = tour_order(gate);
  order.push_back(kNeutralGear);
  double time = 0.0;
  for (const HandStroke& stroke : shift_strokes(gate, rest_position(gate, kNeutralGear), order)) {
    const int slot = slot_at(gate, stroke.to);
    const double there = time + stroke.duration;
    if (slot != kNoSlot) gears_.push_back({gate.slot[static_cast<std::size_t>(slot)].gear, there});
    time = there + stroke.dwell;
  }
  gears_.push_back({kNeutralGear, time});
}

DriverControls TouringFeet::at(double time, const VehicleState& car) const {
  const double now = std::fmod(time, lap_);
  DriverControls feet = feet_at(now, gears_, car);
  const bool between_laps = now < gears_.front().time || now >= gears_.back().time;
  if (between_laps && car.road_speed < 0.0) feet.brake = 1.0;
  return feet;
}

DriverControls deeper(DriverControls feet, const DriverControls& person) noexcept {
  DriverControls both = person;
  both.throttle = std::max(feet.throttle, person.throttle);
  both.brake = std::max(feet.brake, person.brake);
  both.clutch = std::max(feet.clutch, person.clutch);
  return both;
}

}  // namespace gearshift
