// Two ways to make any force passive, however it was computed. They are fallbacks: both reduce the displayed stiffness.
//
// This work is based on:
// J.-P. Kim, J. Ryu. Robustly Stable Haptic Interaction Control using an Energy-bounding Algorithm. 2010
// B. Hannaford, J.-H. Ryu. Time-Domain Passivity Control of Haptic Interfaces. 2002
//
// Each treats one axis as a port with a force F, held for a period, and the travel dx during that period. The energy
// supplied to the lever is exactly F dx, because F was held.
#pragma once

#include <cstdint>

#include "haptics/joystick/plant.h"

namespace gearshift::haptics {

enum class EnergyControl : std::uint8_t {
  none,
  energy_bounding,      // limits the force so that it never supplies more than the device's own damping dissipates
  passivity_controller  // tracks the energy balance; damps once more energy was supplied than absorbed
};
const char* to_string(EnergyControl control) noexcept;  // "energy bounding"

// |F_n| <= |F_(n-1) - c dx|, c = b / (T (1 + 2 delay)): half the stiffness that the paper's eq (13) allows, so that a
// lever pushed into such a wall comes to rest. With the storage S = F^2 / (2 c) and no delay,
//     S_n <= S_(n-1) - F_(n-1) dx + (c / 2) dx^2
// and the last term is less than the energy that the device's damping dissipates during that travel, at least b dx^2 /
// T: so the device is passive for any wanted force. This holds for the measured travel; encoder quantisation adds the
// energy of an error of one count in dx.
class EnergyBounder {
 public:
  EnergyBounder(const AxisModel& handle, int delay, double period) noexcept;  // delay [samples], period [s]

  // The wanted force, limited to the force that may be commanded [N]. last: the last command [N]; travel: motion since
  // then [m].
  double bound(double wanted, double last, double travel) const noexcept;

 private:
  double slope_;  // [N/m] c
};

// Adds damping once more energy was supplied than absorbed since the contact began, to dissipate the surplus.
class PassivityController {
 public:
  PassivityController(const AxisModel& handle, double period) noexcept;  // period [s]

  void reset() noexcept { absorbed_energy_ = 0.0; }

  // The wanted force [N] with the damping added. last: the force that acted during the last period [N]; travel: motion
  // during that period [m]; in_contact: the energy balance restarts with every contact.
  double control(double wanted, double last, double travel, bool in_contact) noexcept;

  double absorbed_energy() const noexcept { return absorbed_energy_; }  // [J] net energy absorbed from the lever

 private:
  double period_;
  double max_damping_;  // [N s/m] highest stable damping of a sampled damper on the handle
  double absorbed_energy_ = 0.0;
};

}  // namespace gearshift::haptics
