// Names for recordings.
#pragma once

#include <filesystem>
#include <string>

namespace gearshift::session {

// Returns the path of the first of NAME.trace, NAME-2.trace, NAME-3.trace, ... that does not exist in the folder yet.
std::filesystem::path unused_trace_path(const std::filesystem::path& folder, const std::string& name);

// Returns a name like "drive-20260131-174205-4711" from `prefix`, local time and process id. The process id prevents
// two processes from making the same name.
std::string recording_name(const std::string& prefix);

}  // namespace gearshift::session
