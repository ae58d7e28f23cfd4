// A scripted hand that shifts while the motors are on and holds still while they are off. So a tour waits until the
// program is armed, and continues after a fault once it is armed again.
#pragma once

#include "haptics/device/scripted_hand.h"
#include "haptics/gate/gate.h"

namespace gearshift::test {

class TouringHand final : public haptics::HandDriver {
 public:
  // Shifts through every gear of the gate. period [s] of the calls to next().
  TouringHand(const haptics::Gate& gate, double period);

  void work(bool works) noexcept { works_ = works; }
  bool done() const noexcept { return time_ > script_.duration(); }
  haptics::HandTarget next(double time, glm::dvec2 lever) noexcept override;

 private:
  haptics::ScriptedHand script_;
  double period_;       // [s]
  double time_ = -1.0;  // [s] of the script; negative during the motors' ramp
  bool works_ = false;
  haptics::HandTarget target_;
};

}  // namespace gearshift::test
