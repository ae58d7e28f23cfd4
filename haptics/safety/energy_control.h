// Two ways to make any force passive, however it was computed. Both are fallbacks, because they reduce the displayed
// stiffness.
//
// This work is based on:
// J.-P. Kim, J. Ryu. Robustly Stable Haptic Interaction Control using an Energy-bounding Algorithm. 2010
// B. Hannaford, J.-H. Ryu. Time-Domain Passivity Control of Haptic Interfaces. 2002
//
// Each method treats one axis as a port with a force F, which is constant during a period, and the travel dx during
// that period. So the energy supplied to the lever is exactly F dx.
#pragma once

#include <cstdint>

#include "haptics/joystick/plant.h"

namespace gearshift::haptics {

enum class EnergyControl : std::uint8_t {
  none,
  energy_bounding,      // limits the force so that it never supplies more than the device's own damping dissipates
  passivity_controller  // adds damping once the lever has received more energy than it returned
};
const char* to_string(EnergyControl control) noexcept;  // "energy bounding"
const char* file_key(EnergyControl control) noexcept;   // "energy_bounding", as in files
constexpr EnergyControl last_value(EnergyControl) {
  return EnergyControl::passivity_controller;
}

// Limits the force F after the travel dx to |F_n| <= |F_(n-1) - c dx|. The slope c = b / (T (1 + 2 delay)), with the
// device's damping b and the period T, is half the stiffness that Kim and Ryu's eq (13) allows, so that a lever
// pushed into a wall of stiffness c comes to rest. With the stored energy S = F^2 / (2 c) and no delay,
//     S_n <= S_(n-1) - F_(n-1) dx + (c / 2) dx^2
// The last term is less than the energy that the device's damping dissipates during the travel, which is at least
// b dx^2 / T. So the device is passive for any wanted force. This holds for the measured travel; encoder quantisation
// adds the energy of an error of one count in dx.
class EnergyBounder {
 public:
  EnergyBounder(const AxisModel& handle, int delay, double period) noexcept;  // delay [samples], period [s]

  // Returns the limited force [N]. `wanted` [N]: force before the limit. `last` [N]: the previous command. `travel`
  // [m]: motion since the previous command.
  double bound(double wanted, double last, double travel) const noexcept;

 private:
  double slope_;  // [N/m] c
};

// If the lever has received more energy than it returned since the contact began, adds damping that dissipates the
// surplus.
class PassivityController {
 public:
  PassivityController(const AxisModel& handle, double period) noexcept;  // period [s]

  void reset() noexcept { absorbed_energy_ = 0.0; }

  // Returns the wanted force [N] with the damping added. `last` [N]: the force that acted during the previous period.
  // `travel` [m]: motion during that period. `in_contact`: true if the lever touches a wall. The energy balance
  // restarts with every contact.
  double control(double wanted, double last, double travel, bool in_contact) noexcept;

 private:
  double period_;
  double max_damping_;            // [N s/m] highest stable damping of a sampled damper on the handle
  double absorbed_energy_ = 0.0;  // [J] net energy absorbed from the lever since the contact began
};

}  // namespace gearshift::haptics
