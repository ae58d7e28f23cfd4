// A scripted hand that shifts through all gears (a tour) while the motors are on, and holds still while they are off.
// So a tour waits until the program turns the forces on, and after a fault continues when the forces are on again.
#pragma once

#include "haptics/device/scripted_hand.h"
#include "haptics/gate/gate.h"

namespace gearshift::test {

class TouringHand final : public haptics::HandDriver {
 public:
  // Shifts through every gear of the gate. `period` [s]: interval between calls of next().
  TouringHand(const haptics::Gate& gate, double period);

  void work(bool works) noexcept { works_ = works; }
  bool done() const noexcept { return time_ > script_.duration(); }
  haptics::HandTarget next(double time, glm::dvec2 lever) noexcept override;

 private:
  haptics::ScriptedHand script_;
  double period_;       // [s]
  double time_ = -1.0;  // [s] time in the script; negative while the forces ramp up
  bool works_ = false;
  haptics::HandTarget target_;
};

}  // namespace gearshift::test
