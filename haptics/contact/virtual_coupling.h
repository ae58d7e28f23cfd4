// Force between the lever and its proxy, held over one period.
//
// This work is based on:
// R. E. Ellis, N. Sarkar, M. A. Jenkins. Numerical Methods for the Force Reflection of Contact. 1997
// R. B. Gillespie, M. R. Cutkosky. Stable User-Specific Haptic Rendering of the Virtual Wall. 1996
// J. E. Colgate, M. C. Stanley, J. M. Brown. Issues in the Haptic Display of Tool Use. 1995
//
// The force is held for a whole period, so the half-sample hold computes it from the mean depth over that period
// instead of the depth at its start; on entry and exit only the part of the period inside the wall counts. That removes
// regions I and II of the paper's Fig. 6 (b).
#pragma once

#include <cstdint>

#include <glm/vec2.hpp>

#include "haptics/contact/lever_estimator.h"
#include "haptics/contact/lever_observer.h"
#include "haptics/contact/proxy.h"

namespace gearshift::haptics {

// How the force to be held is computed from the sampled motion.
enum class ContactHold : std::uint8_t {
  automatic,    // replaced at the start, by the device's delay and rate; never passed to contact_force()
  zero_order,   // force from the sampled depth, like the paper's wall and the textbook wall
  half_sample,  // force from the mean depth during the coming hold, predicted from the sampled velocity
  observer      // force from the mean depth during the coming hold, predicted by lever_observer.h
};
const char* to_string(ContactHold hold) noexcept;  // "half-sample hold"
const char* hold_key(ContactHold hold) noexcept;   // "half_sample", as in files and on the command line

struct Coupling {
  double stiffness = 5000.0;  // [N/m]
  double damping = 10.0;      // [N s/m] acts along the wall's normal, only inside the wall
  double period = 0.001;      // [s]
  int delay = 0;              // [samples] delay until a command takes effect
  ContactHold hold = ContactHold::half_sample;
};

// Minimum damping of the observer hold. With less, a heavy arm rings, because the observer does not know its mass; with
// more, a bare handle hums on encoder quantisation.
inline constexpr double kMinObserverDamping = 50.0;  // [N s/m]

// Wall force [N] over a hold that begins at depth `begin` and without any wall force would end at depth `free_end`,
// both positive inside the wall [m]. compliance: displacement of the end per unit of force held over the period [m/N].
// Force and motion are solved together: F = K (mean depth) + B (mean speed) of the motion that results under F. On
// entry and exit only the travel inside the wall counts. So with an exact model and B = 0 the wall returns exactly the
// energy it absorbed, to rounding, at any stiffness and period. Never negative.
double solved_force(const Coupling& coupling, double begin, double free_end, double compliance) noexcept;

// solved_force() for a lever that stays inside the wall: linear, may be negative. [N]
double solved_force_inside(const Coupling& coupling, double begin, double free_end, double compliance) noexcept;

struct ContactForce {
  glm::dvec2 force{0.0};       // [N] force on the lever; never pulls it into the wall
  glm::dvec2 mean_proxy{0.0};  // [m] the proxy's mean position during the hold; the gate's feel is evaluated there
};

// Force from the sampled motion, for the zero-order and the half-sample hold. The prediction moves the proxy no further
// than the lever; it does not anticipate a hand-over round a corner. Real-time safe.
ContactForce contact_force(const Coupling& coupling, const Gate& gate, const Passage& passage, const Proxy& proxy,
                           const LeverMotion& motion) noexcept;

// Force from the observed motion, for the observer hold: force and motion over the coming hold are solved together (see
// solved_force). Damping acts on the mean velocity. motion.end must include every commanded force except the wall's.
ContactForce contact_force(const Coupling& coupling, const Gate& gate, const Passage& passage, const Proxy& proxy,
                           const ObservedMotion& motion) noexcept;

}  // namespace gearshift::haptics
