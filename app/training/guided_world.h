// A force that leads the lever to a gear, over whatever lies behind the lever: a teacher's hand on the learner's.
//
// It is apart from the mechanism: the walls are the gearbox and always there, this fades (guidance.h).
#pragma once

#include <string>

#include <glm/vec2.hpp>

#include "haptics/gate/gate.h"
#include "haptics/loop/lever_world.h"

namespace gearshift {

inline constexpr double kGuidancePull = 3.0;  // [N] along the way, at full strength: as the gate's own centring
inline constexpr double kGuidanceRate = 2.0;  // [1/s] at which the strength follows what is asked for
inline constexpr double kGuidanceFades = 1.0 / kGuidanceRate;  // [s] after which none is left of it

// Force on a lever drawn at this point of free space, at full strength, and its potential. Zero where the gate has no
// such gear, and at the gear's rest. [N], [J]
//
//     V / F = X(x) - B (X(x) - X(c)) + (1 - W) S(|y|) + W (S(|y - y_gear|) - |y_gear|)
//
// S(u) is |u|, rounded off within half a slot's width of 0; X(x) = S(x - x_gear) pulls along the aisle. B rises from 0
// at the aisle's wall to 1 one slot's width behind it, c is the slot's centre: in a slot the pull sideways fades, and
// nothing presses on its walls further in. W is 1 over the gear's own column and 0 from the next one on: there the lever
// is led to the gear, elsewhere to the aisle. |force| <= 2.2 F.
glm::dvec2 guidance_force(const Gate& gate, int gear, glm::dvec2 proxy) noexcept;
double guidance_energy(const Gate& gate, int gear, glm::dvec2 proxy) noexcept;

// Strength and gear are DriverControls' guidance and guided_gear. The strength follows at kGuidanceRate, and a new gear
// begins at none: a potential that grows can give no more than itself. Without guidance the output is the inner world's,
// to the bit.
class GuidedWorld final : public LeverWorld {
 public:
  GuidedWorld(LeverWorld& inner, const Gate& gate);  // inner must outlive it; the gate is copied

  LeverOutput step(const LeverInput& in, double period) noexcept override;
  const char* name() const noexcept override { return name_.c_str(); }

 private:
  void follow(const DriverControls& controls, double period) noexcept;

  LeverWorld& inner_;
  Gate gate_;
  std::string name_;
  int gear_ = kNeutralGear;
  double strength_ = 0.0;  // [1]
};

}  // namespace gearshift
