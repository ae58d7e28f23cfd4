// Engine, gearbox shaft and car in a row, with Coulomb grips: what holds, what slips, and how all of it then moves.
//
//     engine --clutch-- shaft --cone or dogs-- car          and each of the three has a grip on the ground:
//        |                |                     |           the engine's friction (it does not turn backwards at all),
//      ground           ground                ground        the shaft's drag, rolling resistance with brakes
//
// Bodies that hold each other move as one. Given loads, motion is unique: it minimises Gauss' constraint with the grips'
// dissipation added, which is strictly convex; so the first consistent guess of what holds is the answer.
#pragma once

#include <array>

namespace gearshift {

enum Body : int { engine_body, shaft_body, car_body };
using PerBody = std::array<double, 3>;  // rad/s, rad/s, m/s and what belongs to them

inline int sign(double x) noexcept {
  return (x > 0.0) - (x < 0.0);
}

enum class GearLink { open, cone, dogs };

struct GripChain {
  PerBody inertia{};  // [kg m^2], [kg m^2], [kg]
  GearLink link = GearLink::open;
  double per_road = 0.0;    // [rad/m] of the shaft where the link is not open; not 0
  double efficiency = 1.0;  // [1] of the gear's teeth under load, dogs in; > 0
};

struct ChainLoads {
  PerBody push{};       // [N m], [N m], [N] of all that is no grip
  PerBody ground{};     // the most that the ground resists, >= 0
  double clutch = 0.0;  // [N m] the most that it carries, >= 0
  double cone = 0.0;    // [N m] the same, at the shaft
};

// 0 holds; +1 and -1 slip or turn, in that direction.
struct GripMode {
  int clutch = 0;  // engine faster than shaft +
  int cone = 0;    // shaft faster than the gear +
  std::array<int, 3> turn{};
};

struct ChainMotion {
  PerBody rate{};       // [rad/s^2], [rad/s^2], [m/s^2]
  double clutch = 0.0;  // [N m] carried from engine to shaft
  double gear = 0.0;    // [N m] carried from shaft to gear, at the shaft
  double drive = 0.0;   // [N] of it at the car
  PerBody ground{};     // [N m], [N m], [N] of the ground on each
  double lacks = 0.0;   // by how much a grip fails to hold, or one that slips goes the wrong way; 0: consistent
};

// Motion in that mode.
ChainMotion move(const GripChain& chain, const ChainLoads& loads, const GripMode& mode) noexcept;

struct Settled {
  GripMode mode;
  ChainMotion motion;
};
// The consistent mode and its motion. `known` says which grips slip already (+1, -1) and which are to be decided (0);
// `guess` is tried first. Where rounding leaves none, the one that lacks least.
Settled settle(const GripChain& chain, const ChainLoads& loads, const GripMode& known, const GripMode& guess) noexcept;

// Speeds after an impact in which the bodies that hold each other in `mode` come to one speed, or to rest with the
// ground, their momentum conserved.
PerBody collide(const GripChain& chain, const PerBody& speed, const GripMode& mode) noexcept;

double kinetic_energy(const GripChain& chain, const PerBody& speed) noexcept;  // [J]

// Do the two bodies of the gear link move as one?
inline bool gear_holds(const GripChain& chain, const GripMode& mode) noexcept {
  return chain.link == GearLink::dogs || (chain.link == GearLink::cone && mode.cone == 0);
}
// [rad/s] between shaft and gear, as seen at the shaft.
inline double cone_slip(const GripChain& chain, const PerBody& speed) noexcept {
  return chain.link == GearLink::cone ? speed[shaft_body] - chain.per_road * speed[car_body] : 0.0;
}

}  // namespace gearshift
