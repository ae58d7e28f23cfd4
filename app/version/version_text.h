#pragma once

#include <string>

namespace gearshift {

// What `--version` prints, without the last line feed: program_name(); commit; build type and compiler; libraries.
std::string version_text();

}  // namespace gearshift
