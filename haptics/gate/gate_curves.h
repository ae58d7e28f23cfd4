// The shapes of the forces along a slot, across the neutral aisle and along it, from a layout's numbers.
// README.md beside this file draws the curve along a slot.
#pragma once

#include <vector>

#include "haptics/gate/feel_curve.h"
#include "haptics/gate/gate_layout.h"

namespace gearshift {

// Where things happen along a slot, as depth from the aisle's centre line. [m] Rising in this order.
struct SlotStations {
  double plateau = 0.0;     // the aisle's centring has reached its full force
  double half_aisle = 0.0;  // the aisle's wall: here the chamfered mouth begins
  double mouth = 0.0;       // and here it ends: the slot proper begins
  double bump = 0.0;        // peak of the mouth bump
  double low = 0.0;         // little force between bump and detent
  double crest = 0.0;       // peak of the detent; an engaged gear is released when the lever comes back to here
  double lock = 0.0;        // peak of the pull-out force
  double engage = 0.0;      // the gear counts from here on
  double rest = 0.0;        // the engaged lever rests here
  double end = 0.0;         // end stop
};
SlotStations slot_stations(const GateLayout& layout);

// Knots of Gate::aisle_feel, Slot::feel and Gate::select_feel. [m], [N], [N/m]
std::vector<FeelKnot> aisle_knots(const GateLayout& layout);
std::vector<FeelKnot> slot_knots(const GateLayout& layout);
std::vector<FeelKnot> select_knots(const GateLayout& layout);

}  // namespace gearshift
