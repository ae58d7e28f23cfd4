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

#include <glm/vec2.hpp>

#include "haptics/contact/lever_estimator.h"
#include "haptics/contact/proxy.h"

namespace gearshift {

struct Coupling {
  double stiffness = 5000.0;  // [N/m]
  double damping = 10.0;      // [N s/m] along the wall's normal, inside the wall only
  double horizon = 0.001;     // [s] prediction: period (1 + 2 delay)
};

struct Coupled {
  glm::dvec2 force{0.0};       // [N] on the lever; never pulls into the wall
  glm::dvec2 mean_proxy{0.0};  // [m] where the proxy will be on average while the force is held: the place to feel at
};

// The prediction takes the proxy no further than the lever goes: a hand-over round a corner is not run ahead of.
// Real-time safe.
Coupled couple(const Coupling& coupling, const Gate& gate, const Passage& passage, const Proxy& proxy,
               const LeverMotion& motion) noexcept;

}  // namespace gearshift
