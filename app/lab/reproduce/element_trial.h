// Shared by the trials of emulated elements: their passivity limits, a lever without walls that is moved by a hand, and
// the force of each hold with its motion.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "app/lab/reproduce/trial.h"
#include "haptics/device/scripted_hand.h"

namespace gearshift::lab {

inline constexpr double kPaperRate = 100.0;  // [Hz] section 3: "the maximum updating frequency of the system at 100 Hz"
inline constexpr double kElementFraction = 0.8;  // [1] used fraction of the paper's limits (14), (16), (18), (20)

struct ElementLimits {
  double spring, damper, mass;  // [N/m], [N s/m], [kg] limit of each element if it is the only one
};
ElementLimits element_limits(const haptics::AxisModel& handle, double period);

// A trial with no forces except the element's: no walls nearby, no feel, no damping by the loop.
Trial free_trial(const Study& study, double rate);

// Runs a trial in which a gripping hand moves the lever along the strokes.
TrialRun run_with_hand(Trial trial, const std::vector<haptics::HandStroke>& strokes, haptics::LeverLoad* load);

// One hold: the force against the hand, and the true motion as (position, velocity, acceleration). [m], [m/s], [m/s^2]
struct ElementHold {
  double time, force;
  glm::dvec3 sampled;  // as the paper's (19) computes it: velocity is half a period old, acceleration a whole one
  glm::dvec3 actual;   // true motion in the middle of the hold
};

std::vector<ElementHold> holds_of(const TrialRun& run, int axis);

}  // namespace gearshift::lab
