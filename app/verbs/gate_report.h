// A compiled gate as a table for people (gate_table.cpp) and as JSON for programs (gate_json.cpp).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "haptics/gate/gate_description.h"
#include "haptics/gate/gate_layout.h"

namespace gearshift {

// Everything that `gearshift gate` speaks of.
struct GateReport {
  GateLayout layout;
  Gate gate;
  GateDescription description;
};

std::string gate_table(const GateReport& report);
std::string gate_json(const GateReport& report);

// What both say.

double millimetres(double metres);                                       // to a nanometre
std::vector<std::string> open_directions(const JunctionInfo& junction);  // "left", "right", ...
const char* axis_name(bool horizontal);                                  // "select" or "shift"
const char* side_name(Side side);                                        // "forward" or "back"
const std::string& junction_name(const GateReport& report,
                                 const Slot& slot);  // of the slot's column: "I", ...

// The two walls of a pair: how far apart, and over what length they face each other. [m]
struct PairSize {
  double width = 0.0, length = 0.0;
  std::vector<std::size_t> walls;  // indices into GateDescription::walls
};
PairSize pair_size(const GateDescription& list, std::size_t pair);

}  // namespace gearshift
