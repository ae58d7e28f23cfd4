// Random gate layouts for property tests: valid by construction, and like those that a user could write.
#pragma once

#include <cstdint>
#include <string>

#include "haptics/gate/gate_layout.h"

namespace gearshift::lab {

// The text of a layout file. The same seed gives the same text on every machine. The gate fits the paper's joystick,
// corners included.
std::string random_layout_text(std::uint64_t seed);
haptics::GateLayout random_layout(
    std::uint64_t seed);  // the same layout, parsed; error messages call the file "random_SEED.toml"

// A layout with sizes and forces from their whole ranges, drawn repeatedly until the gate compiler accepts it.
haptics::GateLayout random_wide_layout(std::uint64_t seed);

}  // namespace gearshift::lab
