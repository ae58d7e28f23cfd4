// A force that leads the lever to a gear, added to the load on the lever: like an instructor's hand on the learner's.
//
// It is separate from the mechanism: the walls belong to the gearbox and are always there, guidance fades (guidance.h).
#pragma once

#include <string>

#include <glm/vec2.hpp>

#include "haptics/gate/gate.h"
#include "haptics/loop/lever_load.h"

namespace gearshift::vehicle {

inline constexpr double kGuidancePull = 3.0;  // [N] along the path, at full strength: like the gate's own centring
inline constexpr double kGuidanceRate = 2.0;  // [1/s] rate at which the strength follows the request
inline constexpr double kGuidanceFadeTime = 1.0 / kGuidanceRate;  // [s] until it has faded out completely

// Force at full strength on a lever drawn at this point of free space, and its potential. Zero if the gate has no such
// gear, and at the gear's rest position. [N], [J]
//
//     V / F = X(x) - B (X(x) - X(c)) + (1 - W) S(|y|) + W (S(|y - y_gear|) - |y_gear|)
//
// S(u) is |u|, rounded off within half a slot's width of 0. X(x) = S(x - x_gear) pulls along the aisle. B rises from 0
// at the aisle's wall to 1 one slot width behind it; c is the slot's centre: inside a slot the sideways pull fades, so
// nothing presses on its walls further in. W is 1 over the gear's own column and 0 from the next column on: over its
// own column the lever is led to the gear, elsewhere to the aisle. |force| <= 2.2 F.
glm::dvec2 guidance_force(const haptics::Gate& gate, int gear, glm::dvec2 proxy) noexcept;
double guidance_energy(const haptics::Gate& gate, int gear, glm::dvec2 proxy) noexcept;

// Strength and gear come from DriverControls' guidance and guided_gear. The strength follows at kGuidanceRate, and a
// new gear starts from zero strength: a growing potential can release no more energy than it holds. Without guidance
// the output equals that of the inner load exactly.
class GuidedLoad final : public haptics::LeverLoad {
 public:
  GuidedLoad(haptics::LeverLoad& inner,
             const haptics::Gate& gate);  // inner must outlive this object; the gate is copied

  haptics::LeverOutput step(const haptics::LeverInput& in, double period) noexcept override;
  const char* replay_parameters() const noexcept override { return name_.c_str(); }

 private:
  void follow(const haptics::DriverControls& controls, double period) noexcept;

  haptics::LeverLoad& inner_;
  haptics::Gate gate_;
  std::string name_;
  int gear_ = haptics::kNeutralGear;
  double strength_ = 0.0;  // [1]
};

}  // namespace gearshift::vehicle
