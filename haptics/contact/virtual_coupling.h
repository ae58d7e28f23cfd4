// Force that couples the lever to its proxy, held constant over one period.
//
// This work is based on:
// R. E. Ellis, N. Sarkar, M. A. Jenkins. Numerical Methods for the Force Reflection of Contact. 1997
// R. B. Gillespie, M. R. Cutkosky. Stable User-Specific Haptic Rendering of the Virtual Wall. 1996
// J. E. Colgate, M. C. Stanley, J. M. Brown. Issues in the Haptic Display of Tool Use. 1995
//
// The force is held for a whole period. So the half-sample hold computes it from the mean depth in the wall over that
// period instead of the depth at its start. When the lever enters or leaves the wall, only the part of the period
// inside the wall counts. This avoids the errors of regions I and II in Fig. 6 (b) of Lin and Young's
// paper (haptics/EQUATIONS.md).
#pragma once

#include <cstdint>

#include <glm/vec2.hpp>

#include "haptics/contact/lever_estimator.h"
#include "haptics/contact/lever_observer.h"
#include "haptics/contact/proxy.h"

namespace gearshift::haptics {

// How the wall force is computed from the lever's motion. The force is held for one period.
enum class ContactHold : std::uint8_t {
  automatic,    // replaced at the start by a hold that suits the device's delay and rate
  zero_order,   // force from the sampled depth, as in the paper and in textbooks
  half_sample,  // force from the mean depth in the coming period, predicted with the sampled velocity
  observer      // force from the mean depth in the coming period, predicted by lever_observer.h
};
const char* to_string(ContactHold hold) noexcept;  // "half-sample hold"
const char* file_key(ContactHold hold) noexcept;   // "half_sample", the name in files and on the command line
constexpr ContactHold last_value(ContactHold) {
  return ContactHold::observer;
}

struct Coupling {
  double stiffness = 5000.0;  // [N/m]
  double damping = 10.0;      // [N s/m] acts along the wall's normal, only inside the wall
  double period = 0.001;      // [s]
  int delay = 0;              // [samples] delay from a command to its effect
  ContactHold hold = ContactHold::half_sample;
};

// Wall damping [N s/m] with which the observer hold is stiffest in motion and quiet in every hand, for a handle of mass
// `mass` [kg] and a force that acts `lag` [s] late, its own period included. Found by search (app/lab/contact/README.md).
constexpr double observed_damping(double mass, double lag) noexcept {
  return 0.7 * mass / lag;
}

// Wall force [N], held over one period. `begin`: depth at the start. `free_end`: depth at the end if the wall exerted
// no force. Both depths are in [m] and positive inside the wall. `compliance`: displacement at the end per newton of
// held force [m/N]. Force F and motion are solved together: F = K (mean depth) + B (mean speed) of the motion that F
// itself produces, with stiffness K and damping B. When the lever enters or leaves the wall, only the travel inside the
// wall counts. So with an exact model and B = 0 the wall returns exactly the energy it absorbed, to rounding, at any
// stiffness and period. Never negative.
double solved_force(const Coupling& coupling, double begin, double free_end, double compliance) noexcept;

// Like solved_force() [N], but for a lever that stays inside the wall during the whole period. The force is linear in
// the depths and may be negative.
double solved_force_inside(const Coupling& coupling, double begin, double free_end, double compliance) noexcept;

struct ContactForce {
  glm::dvec2 force{0.0};       // [N] force on the lever; never pulls the lever into the wall
  glm::dvec2 mean_proxy{0.0};  // [m] mean position of the proxy during the hold, where the gate's feel is evaluated
};

// Force from the sampled motion, for the zero-order and the half-sample hold. The prediction moves the proxy no further
// than the lever and does not predict a change of walls at a corner. Real-time safe.
ContactForce contact_force(const Coupling& coupling, const Gate& gate, const Passage& passage, const Proxy& proxy,
                           const LeverMotion& motion) noexcept;

// Force from the observed motion, for the observer hold: force and motion of the coming period are solved together (see
// solved_force()). Damping acts on the mean velocity. Before the call, the caller must add the effect of every other
// commanded force to `motion.end`.
ContactForce contact_force(const Coupling& coupling, const Gate& gate, const Passage& passage, const Proxy& proxy,
                           const ObservedMotion& motion) noexcept;

}  // namespace gearshift::haptics
