// Random cars, from a moped to a lorry, and random pedal inputs.
#pragma once

#include <cstdint>

#include "app/lab/campaign/chance.h"
#include "app/vehicle/car_load.h"

namespace gearshift::lab {

// A car with nine forward gears and reverse, so that it fits every gate. Its values cover the whole range that a car
// file allows. A seed gives the same car on every machine.
vehicle::CarSpec random_car(std::uint64_t seed);
vehicle::CarStart random_start(std::uint64_t seed);

// Pedals, starter and slope that change at random times.
class CampaignPedals {
 public:
  explicit CampaignPedals(std::uint64_t seed);
  const haptics::DriverControls& at(double time);  // time: [s], must not decrease

 private:
  Chance chance_;
  haptics::DriverControls controls_;
  double next_ = 0.0;  // [s]
};

}  // namespace gearshift::lab
