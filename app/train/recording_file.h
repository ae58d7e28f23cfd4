// Where a drive is recorded to.
#pragma once

#include <filesystem>
#include <string>

namespace gearshift {

// NAME.trace in the folder, or NAME-2.trace, NAME-3.trace ...: the first that is not there yet.
std::filesystem::path free_trace(const std::filesystem::path& folder, const std::string& name);

// "drive-20260131-174205": the local time now.
std::string drive_name();

}  // namespace gearshift
