// Random cars behind the lever, from a moped to a lorry, and random pedals.
#pragma once

#include <cstdint>

#include "app/lab/campaign/chance.h"
#include "app/vehicle/car_load.h"

namespace gearshift::lab {

// A car with nine gears and reverse, so that it fits every gate, and values over the whole range that a car file
// allows. The same seed gives the same file on every machine.
vehicle::CarSpec random_car(std::uint64_t seed);
vehicle::CarStart random_start(std::uint64_t seed);

// Pedals, starter and slope that change at random moments.
class CampaignPedals {
 public:
  explicit CampaignPedals(std::uint64_t seed);
  const haptics::DriverControls& at(double time);  // [s] rising

 private:
  Chance chance_;
  haptics::DriverControls controls_;
  double next_ = 0.0;  // [s]
};

}  // namespace gearshift::lab
