// Implements `devices --calibrate` for a force-feedback stick: opens it, runs the dialog with the user and saves the
// results.
#pragma once

#include <filesystem>
#include <string>

namespace gearshift::runtime {

// wanted: names the stick, see select_stick(). folder: the folder of the calibrations. again: discard an earlier
// calibration. answers: the file descriptor from which the answers of a user or script are read. Questions and results
// go to stdout. Ends after the last step, at the end of the input, or on a signal such as Ctrl-C, always with motors
// off, the device released and finished measurements saved. Returns the exit code. Throws std::runtime_error with one
// sentence.
int calibrate_stick(const std::string& wanted, const std::filesystem::path& folder, bool again, int answers);

}  // namespace gearshift::runtime
