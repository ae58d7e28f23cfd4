// The table of the rules that the runtime checks.
#pragma once

#include <span>

#include "tests/support/xr_runtime/control.h"

namespace gearshift::xr_test {

std::span<const Rule> rules();
const Rule& rule(const char* id);

}  // namespace gearshift::xr_test
