// Random gate layouts for property tests: like those a person could write, valid by construction.
#pragma once

#include <cstdint>
#include <string>

#include "haptics/gate/gate_layout.h"

namespace gearshift::lab {

// The same seed produces the same file on every machine. It fits the paper's joystick, corners included.
std::string random_layout_text(std::uint64_t seed);
haptics::GateLayout random_layout(
    std::uint64_t seed);  // the same, parsed; in messages its file name is "random_SEED.toml"

// Sizes and forces from their whole ranges, drawn until the gate compiler accepts them.
haptics::GateLayout random_wide_layout(std::uint64_t seed);

}  // namespace gearshift::lab
