// A compiled gate as a table for people and as JSON for programs.
#pragma once

#include <string>

#include "haptics/gate/gate_compiler.h"

namespace gearshift {

// Everything that `gearshift gate` speaks of.
struct GateReport {
  GateLayout layout;
  Gate gate;
  GateDescription description;
};

std::string gate_table(const GateReport& report);
std::string gate_json(const GateReport& report);

}  // namespace gearshift
