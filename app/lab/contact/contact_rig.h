// Simulates one contact with the complete haptic cycle of the program. The lever moves at a steady speed into the wall
// of a plain aisle, where a hand pushes or releases it. Measures the true position of the handle, not the encoder reading.
#pragma once

#include <span>
#include <vector>

#include "haptics/device/simulated_lever.h"
#include "haptics/loop/haptic_config.h"

namespace gearshift::lab {

struct ContactCase {
  haptics::HapticConfig haptics;
  haptics::SimulatedLeverConfig lever;
  double speed = 0.3;     // [m/s] impact speed
  double push = 20.0;     // [N] push of the hand after the contact; 0 for a free impact, i.e. without a hand
  double phase = 0.0;     // [1] 0 to 1: fraction of a sampling period at which the lever meets the wall
  double place = 0.0;     // [1] 0 to 1: fraction of an encoder count by which the wall is moved
  double duration = 1.2;  // [s] simulated time after the contact
  double pulse = 0.0;     // [s] decay of a force pulse on each entry into the wall; 0: none, as in the program
};

// Vibration of a handle at 125 Hz above which every finger is taken to feel it [m/s^2]; at other frequencies fingers feel
// less, so a broadband rms over it is an upper bound. It is a choice, because the table of ISO 13091-2 was not at hand.
// Some hands feel a cylinder that they grasp move by less than 0.01 um at 150 to 200 Hz, which is 0.01 m/s^2 (A. J.
// Brisben, S. S. Hsiao, K. O. Johnson. Detection of Vibration Transmitted Through an Object Grasped in the Hand. 1999).
inline constexpr double kFingerThreshold = 0.2;

struct ContactResult {
  double peak = 0.0;       // [m] deepest penetration
  double ripple = 0.0;     // [m] peak-to-peak motion in the last 200 ms
  double displayed = 0.0;  // [N/m] mean motor force divided by mean penetration, in the last 50 ms
  double delivered = 0.0;  // [N] mean motor force in the last 50 ms
  double energy = 0.0;  // [J] work of the motors on the lever in the first contact, from the first force to the last:
                        // with the period of the entry, and with late forces outside the wall
  double impact = 0.0;  // [J] kinetic energy of handle and hand at the impact
  double restitution = 0.0;  // [1] speed after the contact divided by impact speed; 0: the lever stays in the wall
  double damped = 0.0;       // [J] lower bound of the handle's dissipation in the first contact
  double hardness = 0.0;     // [N/m] rate-hardness: fastest rise of the motor force within 5 ms of the impact, over the
                             // impact speed; a force that is held counts as straight between its samples
  double tremble = 0.0;      // [m/s^2] rms acceleration in the last 200 ms
  double force_step = 0.0;   // [N] largest change of the commanded force in one cycle
  double force_ripple = 0.0;  // [N] peak-to-peak commanded force in the last 200 ms
  double stiffness = 0.0;     // [N/m] wall stiffness at the end
  int lowered = 0;            // number of times that the reversal limiter lowered the stiffness
  bool saturated = false;  // the motors were at their limit in the last 200 ms, so the lever was beyond the wall's hold
  bool stopped = false;    // the guard switched the force off because the wall vibrated even after softening
};

ContactResult run_contact(const ContactCase& contact);

// The tuning that the program admits on this lever. Throws std::invalid_argument if it admits none.
haptics::AdmittedTuning admitted_wall(const ContactCase& contact);

// The wall as a moving hand feels it: its complex stiffness Z = -(motor force) / (position) at one frequency.
struct DynamicStiffness {
  double frequency = 0.0;  // [Hz]
  double stiffness = 0.0;  // [N/m] Re Z
  double damping = 0.0;    // [N s/m] Im Z / (2 pi frequency)
  double saturated = 0.0;  // [1] fraction of the cycles in which the motors were at their limit; Z is then too small
};

// Presses the lever 3 mm into the wall, with the admitted stiffness, and swings it there by 1 mm at each frequency; by
// less if the motors are too weak. Model error and jitter are ignored. The reversal limiter is off, because it takes swings
// above 10 Hz for chatter.
std::vector<DynamicStiffness> dynamic_stiffness(const ContactCase& contact, std::span<const double> frequencies);

}  // namespace gearshift::lab
