// A scripted hand that works only while somebody looks after it: it shifts on while the motors are on, and holds still
// while they are off. So a tour waits for the program to be armed, and goes on after a fault when it is armed again.
#pragma once

#include "haptics/device/scripted_hand.h"
#include "haptics/gate/gate.h"

namespace gearshift {

class TouringHand final : public HandDriver {
 public:
  // Through every gear of the gate. period [s] of the calls to next().
  TouringHand(const Gate& gate, double period);

  void work(bool works) noexcept { works_ = works; }
  bool done() const noexcept { return time_ > script_.duration(); }
  HandTarget next(double time, glm::dvec2 lever) noexcept override;

 private:
  ScriptedHand script_;
  double period_;       // [s]
  double time_ = -1.0;  // [s] of the script: the motors' ramp is waited for
  bool works_ = false;
  HandTarget target_;
};

}  // namespace gearshift
