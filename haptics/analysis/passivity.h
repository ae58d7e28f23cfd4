// When is an emulated environment passive on this joystick? The paper's conditions (13)-(20), for any
// environment and with delay.
//
// This work is based on:
// J. E. Colgate, G. G. Schenkel. Passivity of a Class of Sampled-Data Systems: Application to Haptic Interfaces. 1997
// Wei-Ching Lin, Kuu-Young Young. Design of Force-Reflection Joystick System for VR-Based Simulation. Eqs (13)-(20)
//
// Sufficient for stability with every passive hand, not necessary. It has the wrong sign for damping: (20) lets B
// lower the allowed K, the exact boundary (sampled_loop.h) rises with B until about B T / m = 0.8.
#pragma once

#include <complex>
#include <functional>

#include "haptics/analysis/sampled_loop.h"

namespace gearshift {

// E(z): force against the hand per position [N/m], at a point of the unit circle. Real coefficients, no pole at z = 1.
using Environment = std::function<std::complex<double>(std::complex<double> z)>;

// Eq (19): K + B (z - 1)/(T z) + M ((z - 1)/(T z))^2. Each may be 0. K [N/m], B [N s/m], M [kg], period [s] > 0
Environment impedance(double stiffness, double damping, double mass, double period);

// The same environment, its force coming `samples` >= 0 periods later: E(z) z^-samples.
Environment delayed(Environment environment, int samples);

// The wall as the loop makes it: its hold, window, free damping and delay. As in sampled_loop.h, and with its errors;
// the observed hold is refused, too: it contains a model of the device, which this view of the wall keeps apart.
Environment contact(const ContactLaw& law, double period);

// Right side of (13), its largest value over 0 < w <= pi / T: the device's own damping must exceed it. [N s/m]
// For (19) with K, B, M >= 0 and no delay this is K T/2 + B + 2 M/T as in (20); for a spring with d samples of delay
// K (T/2 + d T); for a damper, delayed or not, |B|. Relative accuracy 1e-9 of the largest term.
double damping_demand(const Environment& environment, double period);

// Largest stiffness that stays passive beside the given damping and mass of the environment, on a device of
// damping b; 0 where these alone are too much. All delayed by `delay` samples, all >= 0, period [s] > 0. [N/m]
double passive_stiffness_limit(double device_damping, double damping, double mass, int delay, double period);

// The same for a wall as the loop makes it, the law's own stiffness ignored. Errors as contact().
double passive_stiffness_limit(double device_damping, const ContactLaw& law, double period);

}  // namespace gearshift
