// Where a drive is recorded to.
#pragma once

#include <filesystem>
#include <string>

namespace gearshift {

// NAME.trace in the folder, or NAME-2.trace, NAME-3.trace ...: the first that is not there yet.
std::filesystem::path free_trace(const std::filesystem::path& folder, const std::string& name);

// "drive-20260131-174205-4711": what it is of, the local time now, and the process: no other one makes the same name.
std::string drive_name(const std::string& what);

}  // namespace gearshift
