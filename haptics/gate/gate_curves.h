// Builds the curves of force along a slot, across the neutral aisle and along it, from the numbers of a layout.
// README.md in this folder shows the curve along a slot.
#pragma once

#include <vector>

#include "haptics/gate/feel_curve.h"
#include "haptics/gate/gate_layout.h"

namespace gearshift::haptics {

// Characteristic depths along a slot [m], measured from the neutral aisle's centre line, in increasing order.
struct SlotStations {
  double plateau = 0.0;     // where the neutral aisle's centring force becomes constant
  double half_aisle = 0.0;  // wall of the neutral aisle, where the chamfered mouth begins
  double mouth = 0.0;       // end of the mouth, where the slot proper begins
  double bump = 0.0;        // peak of the force that resists entering the mouth
  double low = 0.0;         // force minimum between bump and detent
  double crest = 0.0;       // peak of the detent force; an engaged gear is released here
  double lock = 0.0;        // peak of the force that resists pulling the lever out of gear
  double engage = 0.0;      // depth at which the gear becomes engaged
  double rest = 0.0;        // rest position of the lever in gear
  double end = 0.0;         // end stop
};
SlotStations slot_stations(const GateLayout& layout);

// Largest radius [m] that a place of a mechanism gets by itself, and the depths in it, as fractions of its radius, at
// which it counts and is released.
inline constexpr double kPlaceRadius = 0.012;
inline constexpr double kPlaceEngage = 0.2, kPlaceRelease = 0.1;

// Knots of a place's Slot::feel against the depth in it.
std::vector<FeelKnot> place_knots(double radius, double lock_force, double detent_force);
// Knots of a centring force that is constant from the distance `width` on.
std::vector<FeelKnot> centring_knots(double force, double width);

// Knots of the curves Gate::aisle_feel, Slot::feel and Gate::select_feel: position [m], force [N], slope [N/m].
std::vector<FeelKnot> aisle_knots(const GateLayout& layout);
std::vector<FeelKnot> slot_knots(const GateLayout& layout);
std::vector<FeelKnot> select_knots(const GateLayout& layout);

}  // namespace gearshift::haptics
