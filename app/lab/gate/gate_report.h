// Formats a compiled gate as a table (gate_table.cpp) and as JSON (gate_json.cpp).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "haptics/gate/gate_description.h"
#include "haptics/gate/gate_layout.h"

namespace gearshift::lab {

// Everything that `gearshift gate` reports.
struct GateReport {
  haptics::GateLayout layout;
  haptics::Gate gate;
  haptics::GateDescription description;
};

std::string gate_table(const GateReport& report);
std::string gate_json(const GateReport& report);

// Helpers of both formats.

double millimetres(double metres);                                                // rounded to a nanometre
std::vector<std::string> open_directions(const haptics::JunctionInfo& junction);  // "left", "right", ...
const char* axis_name(bool horizontal);                                           // "select" or "shift"
const std::string& junction_name(const GateReport& report,
                                 const haptics::Slot& slot);  // name of the slot's column, such as "I"

// [m] Two facing walls: their distance, and the length over which they face each other.
struct PairSize {
  double width = 0.0, length = 0.0;
  std::vector<std::size_t> walls;  // indices into GateDescription::walls
};
PairSize pair_size(const haptics::GateDescription& list, std::size_t pair);

}  // namespace gearshift::lab
