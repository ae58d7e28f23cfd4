// The force curves along a slot, across the neutral aisle and along it, from a layout's numbers. README.md in this
// folder shows the curve along a slot.
#pragma once

#include <vector>

#include "haptics/gate/feel_curve.h"
#include "haptics/gate/gate_layout.h"

namespace gearshift::haptics {

// Characteristic depths along a slot [m], from the aisle's centre line, in increasing order.
struct SlotStations {
  double plateau = 0.0;     // where the aisle's centring reaches its full force
  double half_aisle = 0.0;  // the aisle's wall, where the chamfered mouth begins
  double mouth = 0.0;       // end of the mouth, where the slot proper begins
  double bump = 0.0;        // peak of the mouth bump
  double low = 0.0;         // force minimum between bump and detent
  double crest = 0.0;       // peak of the detent; an engaged gear is released when the lever returns to here
  double lock = 0.0;        // peak of the pull-out force
  double engage = 0.0;      // depth at which the gear becomes engaged
  double rest = 0.0;        // rest position of the engaged lever
  double end = 0.0;         // end stop
};
SlotStations slot_stations(const GateLayout& layout);

// Knots of Gate::aisle_feel, Slot::feel and Gate::select_feel. [m], [N], [N/m]
std::vector<FeelKnot> aisle_knots(const GateLayout& layout);
std::vector<FeelKnot> slot_knots(const GateLayout& layout);
std::vector<FeelKnot> select_knots(const GateLayout& layout);

}  // namespace gearshift::haptics
