#pragma once

#include <string>

namespace gearshift::base {

// Name and version, e.g. "gearshift 0.1.0", as written to traces and pages.
std::string program_name();

}  // namespace gearshift::base
