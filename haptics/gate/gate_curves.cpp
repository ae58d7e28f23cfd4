#include "haptics/gate/gate_curves.h"

#include <algorithm>
#include <cstddef>

namespace gearshift::haptics {
namespace {

// Positions along the slot proper, as fractions of its length from the end of the mouth (0) to the end stop (1), so
// that the curve scales with the slot. As in a real gate, the detent begins at about a quarter of the way, and the
// lock is in the second half.
constexpr double kBump = 0.14;
constexpr double kLow = 0.28;
constexpr double kCrest = 0.42;
constexpr double kLock = 0.66;
constexpr double kRest = 0.86;

// Beyond the crest of the detent the lock pulls the lever in. The gear engages at three quarters of the way from the
// crest to the rest position.
constexpr double kEngage = kCrest + 0.75 * (kRest - kCrest);

// A spring's force as a fraction of its largest force: (3 u - u^3) / 2. It reaches 1 with slope 0 at u = 1. It is an
// odd function with zero curvature at u = 0, so it is also smooth where u changes its sign.
constexpr double kSpringSlope = 1.5;  // slope at u = 0, in units of (largest force) / length

double spring(double u) {
  return u * (3.0 - u * u) / 2.0;
}
double spring_slope(double u) {
  return kSpringSlope * (1.0 - u * u);
}

// Adds two knots for each column whose own spring is stiffer than what acts before it, from the neutral column outwards.
// The force rises between the mouths of the columns, because in a mouth it must not depend on x.
void add_column_springs(const GateLayout& layout, int outward, std::vector<FeelKnot>& knots) {
  const double mouth = layout.slot_width / 2.0 + layout.chamfer;
  double force = layout.feel.center_force;
  const int count = static_cast<int>(layout.columns.size());
  for (int i = layout.neutral_column + outward; i >= 0 && i < count; i += outward) {
    const ColumnLayout& column = layout.columns[static_cast<std::size_t>(i)];
    if (column.spring_force <= force) continue;
    const double before = layout.columns[static_cast<std::size_t>(i - outward)].position;
    knots.push_back({before + outward * mouth, -outward * force, 0.0});
    knots.push_back({column.position - outward * mouth, -outward * column.spring_force, 0.0});
    force = column.spring_force;
  }
}

}  // namespace

std::vector<FeelKnot> centring_knots(double force, double width) {
  return {{0.0, 0.0, -kSpringSlope * force / width}, {width, -force, 0.0}};
}

std::vector<FeelKnot> place_knots(double radius, double lock_force, double detent_force) {
  const double crest = (1.0 - kPlaceEngage) * radius, lock = 0.4 * radius;  // distances from the place
  return {{0.0, 0.0, 0.0},
          {radius - crest, -detent_force, 0.0},
          {radius - lock, lock_force, 0.0},
          {radius, 0.0, -kSpringSlope * lock_force / lock}};
}

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

// At the chamfered mouth, free space narrows with depth. The force towards neutral must not depend on depth there: only
// a constant force makes the energy of a point independent of the path round the chamfer. So the force is the same at
// the knots `plateau` and `mouth`, whatever follows deeper in the slot.
std::vector<FeelKnot> slot_knots(const GateLayout& layout) {
  const SlotStations s = slot_stations(layout);
  const FeelLayout& feel = layout.feel;
  const double low = std::min({feel.aisle_force, feel.mouth_force, feel.detent_force});
  const double lock_width = s.rest - s.lock;
  const double stiffness = feel.lock_force / lock_width;  // [N/m] lock force divided by the width of the lock's spring
  const double past_rest = (s.end - s.rest) / lock_width;

  std::vector<FeelKnot> knots = aisle_knots(layout);
  if (s.mouth > s.plateau) knots.push_back({s.mouth, -feel.aisle_force, 0.0});
  if (layout.sequential_gears > 0) {  // behind the crest the drum falls into the gear; the lever always returns
    knots.push_back({s.crest, -feel.detent_force, 0.0});
    knots.push_back({s.lock, -feel.aisle_force, 0.0});
    return knots;
  }
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
  std::vector<FeelKnot> knots{{center - half_width, force, 0.0},
                              {center, 0.0, -kSpringSlope * force / half_width},
                              {center + half_width, -force, 0.0}};
  add_column_springs(layout, +1, knots);
  std::vector<FeelKnot> left;
  add_column_springs(layout, -1, left);
  knots.insert(knots.begin(), left.rbegin(), left.rend());
  return knots;
}

}  // namespace gearshift::haptics
