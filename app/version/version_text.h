#pragma once

#include <string>

namespace gearshift {

// What `--version` prints, without the last line feed: program_name(); commit; build type and compiler; libraries.
std::string version_text();

// Of the source it was built from: "0123456789ab", with "-dirty" where files were changed; "unknown" without git.
std::string commit_text();

}  // namespace gearshift
