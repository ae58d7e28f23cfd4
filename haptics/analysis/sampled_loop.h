// Exact stability of lever, hand and wall in contact: the spectral radius of one whole cycle.
//
// While the lever stays inside a wall and nothing saturates, one cycle is a linear map of a finite state: the plant's
// position and velocity, the velocity estimator's past samples, the filter of the smooth velocity, and the delayed
// forces. The contact is stable if and only if the spectral radius of this map is below 1. No passivity argument and no
// approximation of the hold is needed. (Gil, Sanchez, Hulin, Preusche, Hirzinger. Stability Boundary for Haptic
// Rendering. 2009, and Hulin et al. 2014, give rules for special cases.)
#pragma once

#include "haptics/contact/virtual_coupling.h"
#include "haptics/device/hand.h"
#include "haptics/device/haptic_device.h"
#include "haptics/joystick/plant.h"

namespace gearshift::haptics {

// The wall's force as a function of the lever's motion along one axis, as the loop renders it.
struct ContactLaw {
  ContactHold hold = ContactHold::half_sample;  // ContactHold::automatic is treated as half_sample
  double stiffness = 0.0;                       // [N/m] 0 to 1e9, stiffness of the wall
  double damping = 0.0;                         // [N s/m] 0 to 1e6, damping of the wall; times estimated velocity
  int window = 1;                               // [samples] 1 to kMaxWindow, span of the velocity estimate
  double free_damping = 0.0;                    // [N s/m] 0 to 1e6, damping everywhere; times smooth velocity
  double smoothing = 0.004;                     // [s] 1e-6 to 1e3, time constant of the smooth velocity
  int delay = 0;                                // [samples] 0 to kMaxLoopDelay, from write() to the effect of the force
};

// Throws std::invalid_argument with one sentence if a parameter of the law (ranges above) or the period (1e-6 to 1 s)
// is out of range. The functions below throw for the same reasons, and if the hand is elastic, or if handle or hand is out
// of range: mass 1e-3 (hand: 0) to 1e3 kg, damping 0 to 1e4 N s/m, stiffness 0 to 1e6 N/m.
void check_contact(const ContactLaw& law, double period);

// Spectral radius of one cycle of handle and hand together, with the hand's target fixed. The contact is stable if the
// radius is below 1. For a free mass without spring and damper the radius is 1, up to rounding. period: [s]
double spectral_radius(const AxisModel& handle, const HandImpedance& hand, const ContactLaw& law, double period);

// Stiffness [N/m] below which every wall is stable, with relative accuracy 1e-9; law.stiffness is ignored. Returns 0 if
// even 1e-7 m / T^2 is unstable, with mass m of handle and hand and period T; infinite if 1e9 N/m is still stable. The
// search tests stiffnesses a factor of 1.25 apart, so it may miss a narrower unstable band.
double stiffness_limit(const AxisModel& handle, const HandImpedance& hand, const ContactLaw& law, double period);

}  // namespace gearshift::haptics
