// A hand that needs nobody: through every gear of the gate and back to neutral, over and over.
#pragma once

#include <cstdint>

#include "haptics/device/scripted_hand.h"
#include "haptics/gate/gate.h"

namespace gearshift {

class TouringHand final : public HandDriver {
 public:
  // period: of the calls to next() [s]. seed: of its aims, the same in every lap. Starts at rest in neutral.
  TouringHand(const Gate& gate, std::uint64_t seed, double period);

  HandTarget next(double time, glm::dvec2 lever) noexcept override;
  double lap() const noexcept { return hand_.duration(); }  // [s]

 private:
  ScriptedHand hand_;
};

}  // namespace gearshift
