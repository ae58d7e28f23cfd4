// Prints tachometer and speedometer of the current car.
#pragma once

#include <array>

#include "app/cabin/stage/instruments.h"
#include "app/vehicle/vehicle_state.h"
#include "engine/model/model.h"

namespace gearshift::cabin {

// The dials in the cabin's model file have scales of their own. This class replaces them, in the base-colour and the
// emissive texture, by the scales that fit the car (tach_scale, speed_scale); arc, ticks and numbers of the tachometer
// are red from the car's red line to the end of the scale.
class DialPrint {
 public:
  // Throws std::runtime_error if the model has no dial textures.
  explicit DialPrint(const engine::Model& model);

  // Prints into the model's textures. Without a car, the dials are not changed. Returns true if they changed.
  bool print(engine::Model& model, const vehicle::VehicleState& car);

 private:
  std::array<int, 2> texture_;  // indices of the base-colour and the emissive texture
  DialScale tach_, speed_;      // printed last; empty: as in the model file
  double red_line_ = 0.0;       // [rad/s] printed last
  vehicle::SpeedUnit unit_ = vehicle::SpeedUnit::km_per_h;
};

}  // namespace gearshift::cabin
