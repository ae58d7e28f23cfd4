// The controllers known to the runtime, and the values of bindings to their inputs.
#pragma once

#include <string>
#include <string_view>

#include "tests/support/xr_runtime/control.h"

namespace gearshift::xr_test {

bool knows_profile(std::string_view profile);
bool has_source(std::string_view profile, std::string_view path);  // path: a component, or the input that contains it

// Value of an input at a time [s]. A path without a component means the only component of that input.
float read_scalar(const Script& script, const std::string& path, double t);

}  // namespace gearshift::xr_test
