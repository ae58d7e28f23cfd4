// Simulates one contact through the whole shipped cycle: a lever moves at a steady speed into the wall of a plain aisle
// and is pushed or released there. Measures the true handle, not the encoder.
#pragma once

#include "haptics/device/simulated_lever.h"
#include "haptics/loop/haptic_config.h"

namespace gearshift::lab {

struct ContactCase {
  haptics::HapticConfig haptics;
  haptics::SimulatedLeverConfig lever;
  double speed = 0.3;     // [m/s] impact speed
  double push = 20.0;     // [N] push of the hand after the contact; 0 with no hand: a free impact
  double phase = 0.0;     // [1] 0 to 1: fraction of a sampling period at which the lever meets the wall
  double duration = 1.2;  // [s] simulated after the contact
};

struct ContactResult {
  double peak = 0.0;          // [m] deepest penetration
  double ripple = 0.0;        // [m] peak-to-peak of the last 200 ms
  double displayed = 0.0;     // [N/m] mean motor force divided by mean penetration, last 50 ms
  double delivered = 0.0;     // [N] mean motor force in the last 50 ms
  double energy = 0.0;        // [J] supplied to the lever by the motors in the first contact
  double impact = 0.0;        // [J] kinetic energy of handle and hand at the impact
  double restitution = 0.0;   // [1] ratio of the speed on leaving the wall to the impact speed; 0: it stayed
  double damped = 0.0;        // [J] lower bound of the handle's dissipation in the first contact: sum of b dx^2 / T
  double force_step = 0.0;    // [N] largest change of the command in one cycle
  double force_ripple = 0.0;  // [N] peak-to-peak of the command in the last 200 ms
  double stiffness = 0.0;     // [N/m] wall stiffness in use at the end
  int lowered = 0;            // number of times that the reversal limiter lowered the stiffness
  bool stopped = false;       // the guard switched the force off because softening did not help
};

ContactResult run_contact(const ContactCase& contact);

}  // namespace gearshift::lab
