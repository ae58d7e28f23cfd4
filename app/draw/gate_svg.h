// A compiled gate as a drawing.
#pragma once

#include <string>
#include <string_view>

#include "haptics/gate/gate_description.h"

namespace gearshift {

// A whole SVG document: plate, aisles, walls by role, gears at rest, junctions, buffers, lockouts, a scale in
// millimetres, a legend of what occurs, and the force along a slot.
std::string gate_svg(const Gate& gate, const GateDescription& description, std::string_view title);

}  // namespace gearshift
