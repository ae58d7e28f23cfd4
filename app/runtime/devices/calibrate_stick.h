// Implements `devices --calibrate` for a force-feedback stick: opens it, runs the dialog with the user and saves the
// results.
#pragma once

#include <filesystem>
#include <string>

namespace gearshift::runtime {

// `wanted` names the stick as in select_stick(). `folder` contains the calibrations. If `again` is true, an earlier
// calibration is discarded. The answers of a user or script are read from the file descriptor `answers`. Questions and
// results go to stdout. The dialog ends after the last step, at the end of the input, or on a signal such as Ctrl-C.
// Then the motors are off, the device is released and finished measurements are saved. Returns the exit code. Throws
// std::runtime_error with a one-sentence message.
int calibrate_stick(const std::string& wanted, const std::filesystem::path& folder, bool again, int answers);

}  // namespace gearshift::runtime
