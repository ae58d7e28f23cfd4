// Draws a compiled gate.
#pragma once

#include <string>
#include <string_view>

#include "haptics/gate/gate_description.h"

namespace gearshift::lab {

// Returns a complete SVG document: plate, aisles, walls by role, rest positions, junctions, buffers, lockouts, a scale
// in millimetres, a legend, and a plot of the force along a slot.
std::string gate_svg(const haptics::Gate& gate, const haptics::GateDescription& description, std::string_view title);

}  // namespace gearshift::lab
