// The feet of the hand that needs nobody: as feet_at(), lap after lap.
#pragma once

#include <vector>

#include "app/train/gear_time.h"
#include "app/vehicle/vehicle_state.h"
#include "haptics/gate/gate.h"
#include "haptics/loop/lever_world.h"

namespace gearshift {

class TouringFeet {
 public:
  explicit TouringFeet(const Gate& gate);  // of TouringHand's laps through that gate

  DriverControls at(double time, const VehicleState& car) const;  // [s] of the hand

  const std::vector<GearTime>& gears() const noexcept { return gears_; }  // of a lap, when the hand has put them in
  double lap() const noexcept { return lap_; }                            // [s]

 private:
  std::vector<GearTime> gears_;
  double lap_ = 0.0;
};

// What a person's feet add.
DriverControls deeper(DriverControls feet, const DriverControls& person) noexcept;

}  // namespace gearshift
