// Two ways to make any force passive, whatever computed it. Fallbacks: both cost displayed stiffness.
//
// This work is based on:
// J.-P. Kim, J. Ryu. Robustly Stable Haptic Interaction Control using an Energy-bounding Algorithm. 2010
// B. Hannaford, J.-H. Ryu. Time-Domain Passivity Control of Haptic Interfaces. 2002
//
// Each sees one axis as a port: a force F that was held over a period, and the travel dx in it. The energy that the
// lever was given is F dx, exactly, because F was held.
#pragma once

#include <cstdint>

#include "haptics/joystick/plant.h"

namespace gearshift {

enum class EnergyControl : std::uint8_t {
  none,
  energy_bounding,      // a force that never gives more than the device's own damping takes
  passivity_controller  // counts the energy given, and damps once more was given than taken
};

// |F_n| <= |F_(n-1) - c dx|, c = b / (T (1 + 2 delay)): half the stiffness that (13) allows, so that a lever pushed
// into it comes to rest. With the storage S = F^2 / (2 c) and no delay,
//     S_n <= S_(n-1) - F_(n-1) dx + (c / 2) dx^2
// and the last term is less than the device's damping takes over that travel, b dx^2 / T at least: passive whatever
// is wanted. Of the travel as it is measured: an encoder's count adds what a count's error of the travel can.
class EnergyBounder {
 public:
  EnergyBounder(const AxisModel& handle, int delay, double period) noexcept;  // delay [samples], period [s]

  // What may be commanded of the wanted force [N], the last command [N] and the travel since then [m].
  double bound(double wanted, double last, double travel) const noexcept;

 private:
  double slope_;  // [N/m] c
};

// Adds the damping that takes back what was given, as soon as more was given than taken since the contact began.
class PassivityController {
 public:
  PassivityController(const AxisModel& handle, double period) noexcept;  // period [s]

  void reset() noexcept { taken_ = 0.0; }

  // The wanted force [N] with that damping. last: the force that acted over the last period [N]; travel: in it [m];
  // touches: the account is opened anew with every contact.
  double control(double wanted, double last, double travel, bool touches) noexcept;

  double taken() const noexcept { return taken_; }  // [J] from the lever, less what was given back

 private:
  double period_;
  double most_damping_;  // [N s/m] that a sampled damper of this mass bears
  double taken_ = 0.0;
};

}  // namespace gearshift
