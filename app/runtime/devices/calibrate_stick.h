// `devices --calibrate` for a force-feedback stick: opens it, runs the dialog with the user and saves the results.
#pragma once

#include <filesystem>
#include <string>

namespace gearshift::runtime {

// folder: of the calibrations; again: discard an earlier calibration; answers: a file descriptor with the lines of a
// user or a script. Questions and results go to stdout. Ends after the last step, at the end of the input, or on a
// signal such as Ctrl-C: motors off, device released, finished measurements saved. Returns the exit code. Throws
// std::runtime_error with one sentence.
int calibrate_stick(const std::string& wanted, const std::filesystem::path& folder, bool again, int answers);

}  // namespace gearshift::runtime
