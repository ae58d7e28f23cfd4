#include "haptics/gate/gate_curves.h"

#include <algorithm>
#include <cstddef>

namespace gearshift::haptics {
namespace {

// Fractions of the slot proper (from the end of the mouth to the end stop), so that the curve scales with the slot's
// length. A real gate has its latch at about a quarter of the way and its lock in the second half.
constexpr double kBump = 0.14;
constexpr double kLow = 0.28;
constexpr double kCrest = 0.42;
constexpr double kLock = 0.66;
constexpr double kRest = 0.86;

// Beyond the crest the lock pulls the lever in; the gear is engaged at three quarters of the way to rest.
constexpr double kEngage = kCrest + 0.75 * (kRest - kCrest);

// A spring that levels off smoothly at its full force: F(u) = F (3u - u^3)/2, so F(1) = F and F'(1) = 0. Its curvature
// is zero at u = 0, so its odd mirror image joins it with continuous slope.
constexpr double kSpringSlope = 1.5;  // slope at u = 0, in units of F / length

double spring(double u) {
  return u * (3.0 - u * u) / 2.0;
}
double spring_slope(double u) {
  return kSpringSlope * (1.0 - u * u);
}

}  // namespace

SlotStations slot_stations(const GateLayout& layout) {
  SlotStations s;
  s.half_aisle = layout.aisle_width / 2.0;
  s.plateau = s.half_aisle / 2.0;
  s.mouth = s.half_aisle + layout.chamfer;
  s.end = layout.slot_length;
  const double length = s.end - s.mouth;
  s.bump = s.mouth + kBump * length;
  s.low = s.mouth + kLow * length;
  s.crest = s.mouth + kCrest * length;
  s.lock = s.mouth + kLock * length;
  s.engage = s.mouth + kEngage * length;
  s.rest = s.mouth + kRest * length;
  return s;
}

std::vector<FeelKnot> aisle_knots(const GateLayout& layout) {
  const double plateau = slot_stations(layout).plateau;
  const double force = layout.feel.aisle_force;
  return {{0.0, 0.0, -kSpringSlope * force / plateau}, {plateau, -force, 0.0}};
}

// On the chamfers free space narrows with depth, so the force towards neutral must not depend on depth there: only with
// a constant force is the energy of a point independent of the path round the chamfer. Therefore the force is the same
// at the knots `plateau` and `mouth`, whatever follows deeper in the slot.
std::vector<FeelKnot> slot_knots(const GateLayout& layout) {
  const SlotStations s = slot_stations(layout);
  const FeelLayout& feel = layout.feel;
  const double low = std::min({feel.aisle_force, feel.mouth_force, feel.detent_force});
  const double lock_width = s.rest - s.lock;
  const double stiffness = feel.lock_force / lock_width;  // [N/m] scale of the lock's spring
  const double past_rest = (s.end - s.rest) / lock_width;

  std::vector<FeelKnot> knots = aisle_knots(layout);
  if (s.mouth > s.plateau) knots.push_back({s.mouth, -feel.aisle_force, 0.0});
  knots.push_back({s.bump, -feel.mouth_force, 0.0});
  knots.push_back({s.low, -low, 0.0});
  knots.push_back({s.crest, -feel.detent_force, 0.0});
  knots.push_back({s.lock, feel.lock_force, 0.0});
  knots.push_back({s.rest, 0.0, -kSpringSlope * stiffness});
  knots.push_back({s.end, -feel.lock_force * spring(past_rest), -stiffness * spring_slope(past_rest)});
  return knots;
}

std::vector<FeelKnot> select_knots(const GateLayout& layout) {
  const double center = layout.columns.at(static_cast<std::size_t>(layout.neutral_column)).position;
  const double half_width = layout.slot_width / 2.0;
  const double force = layout.feel.center_force;
  return {{center - half_width, force, 0.0},
          {center, 0.0, -kSpringSlope * force / half_width},
          {center + half_width, -force, 0.0}};
}

}  // namespace gearshift::haptics
