#pragma once

#include <string>

namespace gearshift::verbs {

// The output of `--version`, without the final line feed: program_name(), commit, build type and compiler, libraries.
std::string version_text();

// The commit of the source, for example "0123456789ab". If files differ from the commit, "-dirty" is appended.
// "unknown" without git.
std::string commit_text();

}  // namespace gearshift::verbs
