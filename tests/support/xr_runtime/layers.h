// Checks and records the layers that a frame submits.
#pragma once

#include "tests/support/xr_runtime/state.h"

namespace gearshift::xr_test {

std::vector<LayerRecord> read_layers(const XrFrameEndInfo& info);

}  // namespace gearshift::xr_test
