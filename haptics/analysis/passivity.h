// Passivity of a rendered environment on the joystick: the conditions of the paper's eqs (13) to (20), extended to any
// environment and to delay.
//
// This work is based on:
// J. E. Colgate, G. G. Schenkel. Passivity of a Class of Sampled-Data Systems: Application to Haptic Interfaces. 1997
// Wei-Ching Lin, Kuu-Young Young. Design of Force-Reflection Joystick System for VR-Based Simulation. Eqs (13)-(20)
//
// Passivity is sufficient for stability with every passive hand, but not necessary. It has the wrong trend for damping:
// in eq (20) B lowers the allowed K, while the exact boundary (sampled_loop.h) rises with B up to about B T / m = 0.8.
#pragma once

#include <complex>
#include <functional>

#include "haptics/analysis/sampled_loop.h"

namespace gearshift::haptics {

// E(z) at a point z of the unit circle: force that opposes the hand, per unit of position [N/m]. Real coefficients, no
// pole at z = 1.
using Environment = std::function<std::complex<double>(std::complex<double> z)>;

// The paper's eq (19): K + B (z - 1)/(T z) + M ((z - 1)/(T z))^2. K [N/m], B [N s/m] and M [kg] may be 0; period T [s]
// > 0.
Environment impedance(double stiffness, double damping, double mass, double period);

// The environment with its force delayed by `samples` >= 0 periods: E(z) z^-samples.
Environment delayed(Environment environment, int samples);

// The wall as the loop renders it, with hold, window, free damping and delay. Parameter ranges and errors as in
// sampled_loop.h. The observer hold is rejected as well: it contains a model of the device, so it has no E(z) of its
// own.
Environment contact_environment(const ContactLaw& law, double period);

// Damping [N s/m] that the device itself must exceed: the largest value of the right side of eq (13) for 0 < w <= pi /
// T. For eq (19) with K, B, M >= 0 and no delay this is K T/2 + B + 2 M/T as in eq (20); for a spring with d samples of
// delay K (T/2 + d T); for a damper, delayed or not, |B|. Relative accuracy 1e-9 of the largest term.
double damping_demand(const Environment& environment, double period);

// Largest passive stiffness of an environment with the given damping and mass, on a device of damping b; 0 if damping
// and mass alone violate the condition. The whole environment is delayed by `delay` samples. All arguments >= 0, period
// [s] > 0. Result in [N/m].
double passive_stiffness_limit(double device_damping, double damping, double mass, int delay, double period);

// Passive stiffness limit of a wall as the loop renders it; law.stiffness is ignored. Errors as in
// contact_environment().
double passive_stiffness_limit(double device_damping, const ContactLaw& law, double period);

}  // namespace gearshift::haptics
