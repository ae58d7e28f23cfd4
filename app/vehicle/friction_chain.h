// Engine, gearbox shaft and car in a row, coupled by Coulomb friction: which elements stick, which slip, and the motion
// that results.
//
//     engine --clutch-- shaft --cone or dogs-- car          each of the three also has friction against the ground:
//        |                |                     |           the engine's friction and compression,
//      ground           ground                ground        the shaft's drag, rolling resistance with brakes
//
// Bodies that stick together move as one. For given loads the motion is unique: it minimises Gauss' constraint plus the
// dissipation of the friction elements, a strictly convex function. So the first consistent combination of modes is the
// solution.
#pragma once

#include <array>

namespace gearshift::vehicle {

enum Body : int { engine_body, shaft_body, car_body };
using PerBody = std::array<double, 3>;  // indexed by Body; speeds are in rad/s, rad/s, m/s

inline int sign(double x) noexcept {
  return (x > 0.0) - (x < 0.0);
}

enum class GearLink { open, cone, dogs };

struct FrictionChain {
  PerBody inertia{};  // [kg m^2], [kg m^2], [kg]
  GearLink link = GearLink::open;
  double per_road = 0.0;    // [rad/m] shaft speed divided by road speed; may be 0 only if the link is open
  double efficiency = 1.0;  // [1] efficiency of the gear's teeth with dogs engaged, > 0
};

struct ChainLoads {
  PerBody push{};       // [N m], [N m], [N] sum of all forces except Coulomb friction
  PerBody ground{};     // [N m], [N m], [N] limit of the friction against the ground, >= 0
  double clutch = 0.0;  // [N m] capacity, >= 0
  double cone = 0.0;    // [N m] capacity at the shaft
};

// For each element: 0 if it sticks; +1 or -1 if it slips or turns in that direction.
struct FrictionMode {
  int clutch = 0;  // +1: the engine is faster than the shaft
  int cone = 0;    // +1: the shaft is faster than the gear
  std::array<int, 3> turn{};
};

struct ChainMotion {
  PerBody rate{};          // [rad/s^2], [rad/s^2], [m/s^2]
  double clutch = 0.0;     // [N m] torque from engine to shaft
  double gear = 0.0;       // [N m] torque from shaft to gear, measured at the shaft
  double drive = 0.0;      // [N] force of the gear on the car, after losses in the teeth
  PerBody ground{};        // [N m], [N m], [N] friction from the ground on each body
  double violation = 0.0;  // sum of excess over friction limits and of slip in the wrong direction; 0: consistent
};

// Motion in the given mode.
ChainMotion motion_in_mode(const FrictionChain& chain, const ChainLoads& loads, const FrictionMode& mode) noexcept;

struct Solution {
  FrictionMode mode;
  ChainMotion motion;
};
// Returns the consistent mode and its motion. In `known`, +1 and -1 mark elements that are known to slip; the others
// are solved for. `guess` is tried first. If rounding leaves no consistent mode, returns the mode with the smallest
// violation.
Solution solve_modes(const FrictionChain& chain, const ChainLoads& loads, const FrictionMode& known,
                     const FrictionMode& guess) noexcept;

// Returns the speeds after an impact: bodies that stick together in `mode` reach one speed, bodies that stick to the
// ground come to rest. Bodies that stick only to each other conserve their momentum.
PerBody collide(const FrictionChain& chain, const PerBody& speed, const FrictionMode& mode) noexcept;

double kinetic_energy(const FrictionChain& chain, const PerBody& speed) noexcept;  // [J]

// True if the two bodies of the gear link move as one.
inline bool gear_holds(const FrictionChain& chain, const FrictionMode& mode) noexcept {
  return chain.link == GearLink::dogs || (chain.link == GearLink::cone && mode.cone == 0);
}
// Speed of the shaft relative to the gear [rad/s], measured at the shaft; 0 if no cone rubs.
inline double cone_slip(const FrictionChain& chain, const PerBody& speed) noexcept {
  return chain.link == GearLink::cone ? speed[shaft_body] - chain.per_road * speed[car_body] : 0.0;
}

}  // namespace gearshift::vehicle
