// The controllers that the runtime knows, and the values of their inputs.
#pragma once

#include <string>
#include <string_view>

#include "tests/support/xr_runtime/control.h"

namespace gearshift::xr_test {

bool knows_profile(std::string_view profile);
bool has_source(std::string_view profile, std::string_view path);  // `path`: an input, or one of its components

// Value of an input at time t [s]. A path without a component means the input's /value or /click.
float read_scalar(const Script& script, const std::string& path, double t);

}  // namespace gearshift::xr_test
