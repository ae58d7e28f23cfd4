// Force between the lever and its proxy: half-sample hold with damping.
//
// This work is based on:
// R. E. Ellis, N. Sarkar, M. A. Jenkins. Numerical Methods for the Force Reflection of Contact. 1997
// R. B. Gillespie, M. R. Cutkosky. Stable User-Specific Haptic Rendering of the Virtual Wall. 1996
// J. E. Colgate, M. C. Stanley, J. M. Brown. Issues in the Haptic Display of Tool Use. 1995
//
// The force is held for a whole period, so it is made from the mean depth over that period instead of the
// depth at its start; on entry and exit only the part of the period inside the wall counts. That removes the
// regions I and II of the paper's Fig. 6 (b).
#pragma once

#include <cstdint>

#include <glm/vec2.hpp>

#include "haptics/contact/lever_estimator.h"
#include "haptics/contact/lever_observer.h"
#include "haptics/contact/proxy.h"

namespace gearshift {

// What is made of the depth that was sampled.
enum class ContactHold : std::uint8_t {
  automatic,    // one of those below, chosen once for the device's delay and rate; never seen by couple()
  zero_order,   // the force of the sampled depth, as the paper's wall and every textbook's
  half_sample,  // the mean over the coming hold, by the sampled velocity
  observer      // the mean over the coming hold, by a model of lever and hand (lever_observer.h)
};

struct Coupling {
  double stiffness = 5000.0;  // [N/m]
  double damping = 10.0;      // [N s/m] along the wall's normal, inside the wall only
  double period = 0.001;      // [s]
  int delay = 0;              // [samples] whole, until a command acts
  ContactHold hold = ContactHold::half_sample;
};

// Least damping of an observed hold. With less a heavy arm rings, of which the observer does not know; with more a bare
// handle hums on the encoder's counts.
inline constexpr double kObservedDamping = 50.0;  // [N s/m]

// Force of the wall over a hold that begins at a depth and, if no force acted, would end at another, both positive
// inside [m]. compliance: how far a force held over the period moves that end [m/N]. Force and motion are solved
// together: F = K (mean depth) + B (mean speed) of the motion that F itself makes. Entering and leaving, only the way
// inside the wall counts. So with a true model and B = 0 the wall gives back what it took, to rounding, at any
// stiffness and period. [N], never below 0
double solved_force(const Coupling& coupling, double begin, double free_end, double compliance) noexcept;

// The same while the lever stays inside, linear: it may come out negative. [N]
double solved_force_inside(const Coupling& coupling, double begin, double free_end, double compliance) noexcept;

struct Coupled {
  glm::dvec2 force{0.0};       // [N] on the lever; never pulls into the wall
  glm::dvec2 mean_proxy{0.0};  // [m] where the proxy will be on average while the force is held: the place to feel at
};

// By the sampled motion: zero-order or half-sample hold. The prediction takes the proxy no further than the lever goes: a hand-over round a corner is not run ahead of.
// Real-time safe.
Coupled couple(const Coupling& coupling, const Gate& gate, const Passage& passage, const Proxy& proxy,
               const LeverMotion& motion) noexcept;

// By the observed motion: force and motion over the coming hold are solved together, so that with a true model the
// spring gives back what it took and nothing else, at any stiffness and rate. The damping is that of the mean velocity.
// motion.end: with what else is commanded, the wall alone left out.
Coupled couple(const Coupling& coupling, const Gate& gate, const Passage& passage, const Proxy& proxy,
               const ObservedMotion& motion) noexcept;

}  // namespace gearshift
