// A car behind the lever, from a moped's to a lorry's, with feet that do anything at any time.
#pragma once

#include <cstdint>

#include "app/vehicle/car_world.h"
#include "tests/bench/campaign/chance.h"

namespace gearshift {

// Nine gears and reverse, so that it fits every gate; its values over the decades that its file may say. The same seed
// gives the same file on every machine.
CarSpec random_car(std::uint64_t seed);
CarStart random_start(std::uint64_t seed);

// Pedals, starter and slope that change at random moments.
class CampaignFeet {
 public:
  explicit CampaignFeet(std::uint64_t seed);
  const DriverControls& at(double time);  // [s] rising

 private:
  Chance chance_;
  DriverControls controls_;
  double next_ = 0.0;  // [s]
};

}  // namespace gearshift
