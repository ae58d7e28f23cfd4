// The exact stability of lever, hand and wall in contact: the spectral radius of one whole cycle.
//
// While the lever stays inside a wall and nothing saturates, a cycle is a linear map of a finite state: the plant's
// position and velocity, the samples that the velocity estimator remembers, the filter of the smooth velocity, the
// forces under way. Its spectral radius below 1 is stability, exactly: no passivity, no approximation of the hold.
// (Gil, Sanchez, Hulin, Preusche, Hirzinger. Stability Boundary for Haptic Rendering. 2009, and Hulin et al. 2014,
// give rules for special cases of it.)
#pragma once

#include "haptics/contact/virtual_coupling.h"
#include "haptics/device/hand.h"
#include "haptics/device/haptic_device.h"
#include "haptics/joystick/plant.h"

namespace gearshift {

// What pushes the lever back, as the loop does it, along one axis.
struct ContactLaw {
  ContactHold hold = ContactHold::half_sample;  // automatic is taken for half_sample
  double stiffness = 0.0;                       // [N/m] 0 to 1e9, of the wall
  double damping = 0.0;                         // [N s/m] 0 to 1e6, of the wall, on the estimated velocity
  int window = 1;                               // [samples] 1 to kMostWindow, of that estimate
  double free_damping = 0.0;                    // [N s/m] 0 to 1e6, everywhere, on the smooth velocity
  double smoothing = 0.004;                     // [s] 1e-6 to 1e3, time constant of the smooth velocity
  int delay = 0;                                // [samples] 0 to kMostDelay, whole, from write to effect
};

// Throws std::invalid_argument with one sentence where a parameter is out of its range: those above, and period
// 1e-6 to 1 s. So do the functions below; handle and hand have each a mass from 0 (the handle: 1e-3) to 1e3 kg, a
// damping from 0 to 1e4 N s/m and a stiffness from 0 to 1e6 N/m.
void check_contact(const ContactLaw& law, double period);

// Of one cycle, handle and hand together, the hand's target fixed. Stable below 1. period [s]
// A mass that nothing holds or slows has 1, up to rounding: it neither grows nor comes back.
double spectral_radius(const AxisModel& handle, const HandImpedance& hand, const ContactLaw& law, double period);

// Largest stiffness [N/m] up to which every wall is stable, the law's own stiffness ignored: relative accuracy 1e-9.
// 0 where not even a vanishing one is, which is judged at 1e-7 m / T^2, m of handle and hand; infinite where 1e9 N/m
// still is. Found by trying stiffnesses a factor of 1.25 apart: an unstable band narrower than that may be missed.
double stiffness_limit(const AxisModel& handle, const HandImpedance& hand, const ContactLaw& law, double period);

}  // namespace gearshift
