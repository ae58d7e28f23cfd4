// Helpers for trials of emulated elements (spring, damper, mass): the elements' passivity limits, a lever without walls
// that a hand moves, and force and motion in each sampling period.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "app/lab/reproduce/trial.h"
#include "haptics/device/scripted_hand.h"

namespace gearshift::lab {

inline constexpr double kPaperRate = 100.0;  // [Hz] section 3: "the maximum updating frequency of the system at 100 Hz"
inline constexpr double kElementFraction = 0.8;  // [1] fraction of the paper's limits (14), (16), (18), (20)

struct ElementLimits {
  double spring, damper, mass;  // [N/m], [N s/m], [kg] limit of each element if the other two are zero
};
ElementLimits element_limits(const haptics::AxisModel& handle, double period);

// Returns a trial in which only the element causes forces: no walls nearby, no gate forces, no damping by the loop.
Trial free_trial(const Study& study, double rate);

// Runs a trial in which a gripping hand moves the lever along the strokes.
TrialRun run_with_hand(Trial trial, const std::vector<haptics::HandStroke>& strokes, haptics::LeverLoad* load);

// One sampling period: the force against the hand, and position, velocity and acceleration. [N], [m], [m/s], [m/s^2]
struct ElementHold {
  double time, force;
  glm::dvec3 sampled;  // motion as in the paper's eq (19): velocity lags by T/2, acceleration by T (period)
  glm::dvec3 actual;   // true motion in the middle of the period
};

std::vector<ElementHold> holds_of(const TrialRun& run, int axis);

}  // namespace gearshift::lab
