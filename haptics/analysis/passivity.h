// Passivity of a rendered environment on the joystick: the conditions of the paper's eqs (13) to (20), extended to any
// environment and to delay.
//
// This work is based on:
// J. E. Colgate, G. G. Schenkel. Passivity of a Class of Sampled-Data Systems: Application to Haptic Interfaces. 1997
// Wei-Ching Lin, Kuu-Young Young. Design of Force-Reflection Joystick System for VR-Based Simulation. Eqs (13)-(20)
//
// Passivity is sufficient for stability with every passive hand, but not necessary. For damping it even predicts the
// wrong trend: in eq (20) a higher wall damping B lowers the allowed stiffness K. The exact limit (sampled_loop.h)
// rises with B up to about B T / m = 0.8 (period T, mass m).
#pragma once

#include <complex>
#include <functional>

#include "haptics/analysis/sampled_loop.h"

namespace gearshift::haptics {

// Transfer function E(z) of a rendered environment: force that opposes the hand, per unit of position [N/m]. z lies on
// the unit circle. E must have real coefficients and no pole at z = 1.
using Environment = std::function<std::complex<double>(std::complex<double> z)>;

// The paper's eq (19), a spring, damper and mass: K + B (z - 1)/(T z) + M ((z - 1)/(T z))^2. Stiffness K [N/m], damping
// B [N s/m] and mass M [kg] may be 0; period T [s] > 0.
Environment impedance(double stiffness, double damping, double mass, double period);

// The environment with its force delayed by `samples` periods (>= 0): E(z) z^-samples.
Environment delayed(Environment environment, int samples);

// Transfer function of a wall as the loop renders it, with hold, velocity window, free damping and delay. Parameter
// ranges and errors are those of check_contact(). Also throws for the observer hold: it contains a model of the device,
// so it has no transfer function E(z) of its own.
Environment contact_environment(const ContactLaw& law, double period);

// Damping [N s/m] that the device itself must exceed for passivity: the largest right side of eq (13) for angular
// frequencies in (0, pi / T]. Closed forms for stiffness K, damping B, mass M >= 0 and period T: eq (19) without delay
// needs K T/2 + B + 2 M/T, as in eq (20); a spring delayed by d samples needs K (T/2 + d T); a damper, delayed or not,
// needs |B|. Relative accuracy 1e-9 of the largest term.
double damping_demand(const Environment& environment, double period);

// Largest passive stiffness [N/m] of a wall with the given damping and mass, on a device with damping `device_damping`;
// 0 if damping and mass without any stiffness already violate the condition. All forces are delayed by `delay` samples.
// All arguments >= 0, period [s] > 0.
double passive_stiffness_limit(double device_damping, double damping, double mass, int delay, double period);

// Largest passive stiffness [N/m] of a wall as the loop renders it; law.stiffness is ignored. Throws like
// contact_environment().
double passive_stiffness_limit(double device_damping, const ContactLaw& law, double period);

}  // namespace gearshift::haptics
