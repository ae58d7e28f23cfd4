// Random gate layouts for property tests. All are valid and could have been written by a user.
#pragma once

#include <cstdint>
#include <string>

#include "haptics/gate/gate_layout.h"

namespace gearshift::lab {

// Returns the text of a layout file. Equal seeds give equal texts on every machine. The simulated joystick can reach
// the whole gate, including its corners.
std::string random_layout_text(std::uint64_t seed);
haptics::GateLayout random_layout(
    std::uint64_t seed);  // the parsed layout; error messages call the file "random_SEED.toml"

// Draws layouts with sizes and forces from their whole ranges until the gate compiler accepts one.
haptics::GateLayout random_wide_layout(std::uint64_t seed);

}  // namespace gearshift::lab
