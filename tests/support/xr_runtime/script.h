// Reads script files, which are TOML. The allowed keys are those that script.cpp reads.
#pragma once

#include <filesystem>

#include "tests/support/xr_runtime/control.h"

namespace gearshift::xr_test {

Script read_script(const std::filesystem::path& file);  // throws std::runtime_error

}  // namespace gearshift::xr_test
