// Passivity of a rendered environment on the joystick: the paper's conditions (13)-(20), for any environment and with
// delay.
//
// This work is based on:
// J. E. Colgate, G. G. Schenkel. Passivity of a Class of Sampled-Data Systems: Application to Haptic Interfaces. 1997
// Wei-Ching Lin, Kuu-Young Young. Design of Force-Reflection Joystick System for VR-Based Simulation. Eqs (13)-(20)
//
// Passivity is sufficient for stability with every passive hand, but not necessary. It has the wrong trend for damping:
// in (20) B lowers the allowed K, while the exact boundary (sampled_loop.h) rises with B up to about B T / m = 0.8.
#pragma once

#include <complex>
#include <functional>

#include "haptics/analysis/sampled_loop.h"

namespace gearshift::haptics {

// E(z): force opposing the hand per position [N/m], at a point of the unit circle. Real coefficients, no pole at z = 1.
using Environment = std::function<std::complex<double>(std::complex<double> z)>;

// Eq (19): K + B (z - 1)/(T z) + M ((z - 1)/(T z))^2. Each may be 0. K [N/m], B [N s/m], M [kg], period [s] > 0
Environment impedance(double stiffness, double damping, double mass, double period);

// The same environment with its force delayed by `samples` >= 0 periods: E(z) z^-samples.
Environment delayed(Environment environment, int samples);

// The wall as the loop renders it, with hold, window, free damping and delay. Same parameters and errors as in
// sampled_loop.h. The observer hold is rejected as well: it contains a model of the device, so it has no E(z) of its
// own.
Environment contact_environment(const ContactLaw& law, double period);

// Largest value of the right side of (13) over 0 < w <= pi / T: the device's own damping must exceed it. [N s/m]
// For (19) with K, B, M >= 0 and no delay this is K T/2 + B + 2 M/T as in (20); for a spring with d samples of delay
// K (T/2 + d T); for a damper, delayed or not, |B|. Relative accuracy 1e-9 of the largest term.
double damping_demand(const Environment& environment, double period);

// Largest passive stiffness of an environment with the given damping and mass, on a device of damping b; 0 if damping
// and mass are too large by themselves. All delayed by `delay` samples, all >= 0, period [s] > 0. [N/m]
double passive_stiffness_limit(double device_damping, double damping, double mass, int delay, double period);

// The same for a wall as the loop renders it; law.stiffness is ignored. Errors as in contact_environment().
double passive_stiffness_limit(double device_damping, const ContactLaw& law, double period);

}  // namespace gearshift::haptics
