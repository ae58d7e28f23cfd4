// Simulates one contact through the whole shipped cycle: a lever moves at a steady speed into the wall of a plain aisle
// and is pushed or released there. Measures the true handle, not the encoder.
#pragma once

#include "haptics/device/simulated_lever.h"
#include "haptics/loop/haptic_config.h"

namespace gearshift::lab {

struct ContactCase {
  haptics::HapticConfig haptics;
  haptics::SimulatedLeverConfig lever;
  double speed = 0.3;     // [m/s] of the impact
  double push = 20.0;     // [N] of the hand from the contact on; 0 with no hand is a free impact
  double phase = 0.0;     // [1] 0 to 1: when within a sampling period the lever meets the wall
  double duration = 1.2;  // [s] after the contact
};

struct ContactResult {
  double peak = 0.0;          // [m] deepest penetration
  double ripple = 0.0;        // [m] peak-to-peak of the last 200 ms
  double displayed = 0.0;     // [N/m] mean motor force over mean penetration of the last 50 ms
  double delivered = 0.0;     // [N] mean motor force of the last 50 ms
  double energy = 0.0;        // [J] given to the lever by the motors in the first contact
  double impact = 0.0;        // [J] kinetic energy at the contact, handle and hand
  double restitution = 0.0;   // [1] speed on leaving the wall over impact speed; 0: it stayed
  double damped = 0.0;        // [J] lower bound of the handle's dissipation in it: sum of b dx^2 / T
  double force_step = 0.0;    // [N] largest change of the command in one cycle
  double force_ripple = 0.0;  // [N] peak-to-peak of the command in the last 200 ms
  double stiffness = 0.0;     // [N/m] in use at the end
  int lowered = 0;            // number of times that the reversal limiter lowered the stiffness
  bool stopped = false;       // the guard switched the force off because softening did not help
};

ContactResult run_contact(const ContactCase& contact);

}  // namespace gearshift::lab
