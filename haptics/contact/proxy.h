// The proxy: the point of the free space that stands for the lever. It is what is drawn, and what the hand is
// pulled towards.
//
// This work is based on:
// C. B. Zilles, J. K. Salisbury. A Constraint-Based God-Object Method for Haptic Display. 1995
// D. C. Ruspini, K. Kolarov, O. Khatib. The Haptic Display of Complex Graphical Environments. 1997
//
// Free space is a union of convex aisles. The proxy moves straight, inside one aisle at a time, to that
// aisle's nearest point to the lever, and goes on in a neighbouring aisle where that brings it nearer. So it
// can never cross a wall, and its distance to the lever falls with every move: the coupling only ever loses
// energy by it.
#pragma once

#include <glm/vec2.hpp>

#include "haptics/gate/gate.h"
#include "haptics/gate/lockout.h"

namespace gearshift {

struct Proxy {
  glm::dvec2 position{0.0};  // [m] always in free space
  glm::dvec2 lever{0.0};     // [m] lever point of the last move
};

// Proxy after the lever has moved to `lever`. It travels at most |lever - last lever| + hand_over [m], so
// when the governing wall changes the coupling force of stiffness K changes by at most K (2 |lever step| +
// hand_over). Real-time safe; a lever that is not finite leaves the proxy where it is.
Proxy move_proxy(const Gate& gate, const Passage& passage, Proxy proxy, glm::dvec2 lever, double hand_over) noexcept;

// A proxy at the point of free space nearest to the lever, all lockouts open: where a run begins.
Proxy place_proxy(const Gate& gate, glm::dvec2 lever) noexcept;

// Speed at which the proxy runs round a corner when the governing wall changes.
inline constexpr double kHandOverSpeed = 0.5;  // [m/s]

}  // namespace gearshift
