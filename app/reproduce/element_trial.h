// What trials of emulated elements share: how much the conditions admit, a lever in the open that a hand leads, and the
// force of each hold beside the motion.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "app/reproduce/trial.h"
#include "haptics/device/scripted_hand.h"

namespace gearshift {

inline constexpr double kPaperRate = 100.0;  // [Hz] section 3: "the maximum updating frequency of the system at 100 Hz"
inline constexpr double kElementShare = 0.8;  // of what (14), (16), (18), (20) admit

struct ElementLimits {
  double spring, damper, mass;  // [N/m], [N s/m], [kg]: each alone
};
ElementLimits element_limits(const AxisModel& handle, double period);

// The element alone: no wall near, no feel, no damping of the loop's own.
Trial open_trial(const Study& study, double rate);

// Leads the lever by a gripping hand.
TrialRun led_run(Trial trial, const std::vector<HandStroke>& strokes, LeverWorld* world);

// One hold: the force against the hand, and the true motion. [m], [m/s], [m/s^2]
struct ElementHold {
  double time, force;
  glm::dvec3 seen;  // that (19) makes of samples: half a period and a whole one old
  glm::dvec3 felt;  // in the middle of the hold
};

std::vector<ElementHold> holds_of(const TrialRun& run, int axis);

}  // namespace gearshift
