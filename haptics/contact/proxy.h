// The proxy: a point in free space that represents the lever. It is drawn, and the coupling pulls the hand towards it.
//
// This work is based on:
// C. B. Zilles, J. K. Salisbury. A Constraint-Based God-Object Method for Haptic Display. 1995
// D. C. Ruspini, K. Kolarov, O. Khatib. The Haptic Display of Complex Graphical Environments. 1997
//
// Free space is a union of convex aisles. The proxy moves straight within one aisle to that aisle's nearest point to
// the lever, then continues in a neighbouring aisle if that brings it closer. So the proxy can never cross a wall, and
// every move reduces its distance to the lever, which only removes energy from the coupling.
#pragma once

#include <glm/vec2.hpp>

#include "haptics/gate/gate.h"
#include "haptics/gate/lockout.h"

namespace gearshift::haptics {

struct Proxy {
  glm::dvec2 position{0.0};  // [m] always in free space
  glm::dvec2 lever{0.0};     // [m] lever point at the last move
};

// The proxy after the lever has moved to `lever`. It travels at most |lever - last lever| + hand_over [m], so when the
// wall that holds it changes, the force of a coupling of stiffness K changes by at most K (2 |lever step| + hand_over).
// Real-time safe; a lever that is not finite leaves the proxy unchanged.
Proxy move_proxy(const Gate& gate, const Passage& passage, Proxy proxy, glm::dvec2 lever, double hand_over) noexcept;

// A proxy at the point of free space nearest to the lever, with all lockouts open; used at the start of a run.
Proxy place_proxy(const Gate& gate, glm::dvec2 lever) noexcept;

// Speed at which the proxy moves round a corner when the wall that holds it changes.
inline constexpr double kHandOverSpeed = 0.5;  // [m/s]

}  // namespace gearshift::haptics
