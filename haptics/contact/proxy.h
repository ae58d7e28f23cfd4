// The proxy: a point in free space that represents the lever. The display shows the proxy, and the coupling pulls the
// hand towards the proxy.
//
// This work is based on:
// C. B. Zilles, J. K. Salisbury. A Constraint-Based God-Object Method for Haptic Display. 1995
// D. C. Ruspini, K. Kolarov, O. Khatib. The Haptic Display of Complex Graphical Environments. 1997
//
// Free space is a union of convex aisles. The proxy moves straight within its aisle to the point nearest to the lever,
// then continues in a neighbouring aisle if that brings the proxy closer to the lever. So the proxy can never cross a
// wall. Every move reduces its distance to the lever, so a move can only remove energy from the coupling.
#pragma once

#include <glm/vec2.hpp>

#include "haptics/gate/gate.h"
#include "haptics/gate/lockout.h"

namespace gearshift::haptics {

struct Proxy {
  glm::dvec2 position{0.0};  // [m] position of the proxy, always in free space
  glm::dvec2 lever{0.0};     // [m] position of the lever at the last move
};

// Returns the proxy after the lever has moved to `lever`. If the lever has moved by d [m] since the previous call, the
// proxy moves by at most d + `hand_over`. So when a different wall starts to hold the proxy, the force of a coupling
// with stiffness K changes by at most K (2 d + hand_over). A lever position that is not finite leaves the proxy
// unchanged. Real-time safe.
Proxy move_proxy(const Gate& gate, const Passage& passage, Proxy proxy, glm::dvec2 lever, double hand_over) noexcept;

// Returns a proxy at the point of free space nearest to the lever, with all lockouts open. For the start of a run.
Proxy place_proxy(const Gate& gate, glm::dvec2 lever) noexcept;

// Speed at which the proxy moves round a corner from one wall to the next.
inline constexpr double kHandOverSpeed = 0.5;  // [m/s]

}  // namespace gearshift::haptics
