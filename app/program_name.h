#pragma once

#include <string>

namespace gearshift {

// "gearshift 0.1.0": in traces and on pages.
std::string program_name();

}  // namespace gearshift
