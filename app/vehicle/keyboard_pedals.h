// Actuator model of the pedals that keys press: moves them in every cycle of the car's clock, so that no pedal jumps at
// a low frame rate. A key takes effect up to one frame late, and the pedal then moves at its normal speed.
#pragma once

#include "haptics/loop/lever_load.h"

namespace gearshift::vehicle {

struct PedalKeys {  // held now
  bool throttle = false, throttle_light = false, brake = false, clutch = false, clutch_hold = false;
};

struct PedalTiming {
  double pedal_time = 0.25;                         // [s] time for the full pedal travel
  double slip_time = 1.2;                           // [s] time in which the rising clutch pedal passes the bite zone
  double clutch_closed = 0.15, clutch_bite = 0.75;  // [1] pedal positions that bound the bite zone: 0 <= closed < bite
  bool operator==(const PedalTiming&) const = default;
};

// `throttle_light` presses the throttle by a fifth of the travel, or less while the engine turns fast and is not
// coupled to the wheels. The released clutch pedal rises fast, but slowly through the bite zone, and stops while
// `clutch_hold` is held. The hand brake does not move.
class KeyboardPedals {
 public:
  explicit KeyboardPedals(const haptics::Pedals& from = {}) noexcept : pedals_(from) {}

  // Moves the pedals by `seconds` of the car's time (negative counts as 0) and returns their positions.
  // `engine_speed`: [rad/s]. `coupled`: the engine drives the wheels. Real-time safe.
  const haptics::Pedals& move(const PedalKeys& keys, const PedalTiming& timing, double seconds, double engine_speed,
                              bool coupled) noexcept;

 private:
  haptics::Pedals pedals_;
};

}  // namespace gearshift::vehicle
