// Gate layouts for property tests: any gate that a person could write, valid by construction.
#pragma once

#include <cstdint>
#include <string>

#include "haptics/gate/gate_layout.h"

namespace gearshift {

// The same seed gives the same file on every machine. It fits the paper's joystick, corners included.
std::string random_layout_text(std::uint64_t seed);
GateLayout random_layout(std::uint64_t seed);  // the same, read; in messages its file is "random_SEED.toml"

// Sizes and forces from anywhere within their ranges, drawn until the gate compiler accepts them.
GateLayout random_wide_layout(std::uint64_t seed);

}  // namespace gearshift
