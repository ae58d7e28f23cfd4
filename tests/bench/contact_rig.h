// One contact: a lever carried at a steady speed into the wall of a plain aisle, and pushed or let go there. The
// whole shipped cycle; what is measured is the true handle, not what the encoder says of it.
#pragma once

#include "haptics/device/simulated_lever.h"
#include "haptics/loop/haptic_config.h"

namespace gearshift {

struct ContactCase {
  HapticConfig haptics;
  SimulatedLeverConfig lever;
  double speed = 0.3;     // [m/s] of the impact
  double push = 20.0;     // [N] of the hand from the contact on; 0 and no hand: a free impact
  double phase = 0.0;     // [1] 0 to 1, of the sampling period at which the lever meets the wall
  double duration = 1.2;  // [s] after the contact
};

struct ContactResult {
  double peak = 0.0;          // [m] deepest penetration
  double ripple = 0.0;        // [m] peak-to-peak of the last 200 ms
  double displayed = 0.0;     // [N/m] mean motor force over mean penetration of the last 50 ms
  double delivered = 0.0;     // [N] mean motor force of the last 50 ms
  double energy = 0.0;        // [J] that the motors gave the lever, over the first contact
  double impact = 0.0;        // [J] kinetic energy at the contact, handle and hand
  double restitution = 0.0;   // [1] speed on leaving the wall over speed on meeting it; 0: it stayed
  double damped = 0.0;        // [J] the least that the handle itself took over it: b dx^2 / T of each period
  double force_step = 0.0;    // [N] largest change of the command in one cycle
  double force_ripple = 0.0;  // [N] peak-to-peak of the command in the last 200 ms
  double stiffness = 0.0;     // [N/m] in use at the end
  int lowered = 0;            // times that the reversal limiter took some of it
  bool stopped = false;       // softening did not calm it: the guard took the force
};

ContactResult run_contact(const ContactCase& contact);

}  // namespace gearshift
