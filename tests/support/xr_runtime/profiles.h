// The controllers that the runtime knows, and what a binding to one of their parts gives.
#pragma once

#include <string>
#include <string_view>

#include "tests/support/xr_runtime/control.h"

namespace gearshift::xr_test {

bool knows_profile(std::string_view profile);
bool has_source(std::string_view profile, std::string_view path);  // a component, or the input that has it

// What an input says at a time [s]. A path without a component means the one that its input has.
float read_scalar(const Script& script, const std::string& path, double t);

}  // namespace gearshift::xr_test
