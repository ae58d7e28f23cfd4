// A force that leads the lever to a gear, like an instructor's hand on the learner's.
//
// Guidance is separate from the gearbox's mechanism: the walls of the mechanism are always there, while guidance fades
// with the learner's progress (guidance.h).
#pragma once

#include <glm/vec2.hpp>

#include "haptics/gate/gate.h"
#include "haptics/loop/lever_load.h"

namespace gearshift::vehicle {

inline constexpr double kGuidancePull = 3.0;  // [N] force at full strength, similar to the gates' centring force
inline constexpr double kGuidanceRate = 2.0;  // [1/s] fastest change of the strength (0 to 1)
inline constexpr double kGuidanceFadeTime = 1.0 / kGuidanceRate;  // [s] time from full to zero strength

// Guidance force F_g [N] at full strength for a proxy at this point: the negative gradient of a potential V [J]. It is
// zero if the gate lacks the gear, and at the gear's rest position. With F = kGuidancePull:
//
//     V / F = X(x) - B (X(x) - X(c)) + (1 - W) S(|y|) + W (S(|y - y_gear|) - |y_gear|)
//
// S(u) is |u|, rounded off within half a slot's width of 0. X(x) = S(x - x_gear) pulls along the aisle. B rises from 0
// at the aisle's wall to 1 one slot width behind it, and c is the centre of the nearest column: inside a slot the
// sideways pull fades, so nothing presses on the slot's walls further in. W is 1 in the gear's own column and 0 from
// the next column on: in the gear's column the lever is led to the gear, elsewhere to the aisle. |F_g| <= 2.2 F.
glm::dvec2 guidance_force(const haptics::Gate& gate, int gear, glm::dvec2 proxy) noexcept;

// Follows DriverControls::guidance and guided_gear. The strength changes by at most kGuidanceRate. When the gear
// changes, the strength first falls to zero and then rises for the new gear. So for each gear, guidance releases at
// most the energy that its potential holds at full strength.
class HandGuidance {
 public:
  explicit HandGuidance(const haptics::Gate& gate) : gate_(gate) {}

  // Returns the force on the lever [N] with the proxy at this point, after `period` [s]. Real-time safe.
  glm::dvec2 step(const haptics::DriverControls& controls, glm::dvec2 proxy, double period) noexcept;

 private:
  haptics::Gate gate_;
  int gear_ = haptics::kNeutralGear;
  double strength_ = 0.0;  // [1]
};

}  // namespace gearshift::vehicle
