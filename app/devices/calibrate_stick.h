// devices --calibrate: the stick is opened, the person is asked, and what was found is kept.
#pragma once

#include <filesystem>
#include <string>

namespace gearshift {

// folder: of the calibrations; again: nothing of an earlier one counts; answers: a file descriptor with a person's lines,
// or a script's. Questions and findings go to stdout. Ends at the last step, at the end of the answers and when asked to
// (Ctrl-C): motors off, the device given back, what was measured kept. Returns the exit code. Throws std::runtime_error
// with one sentence.
int calibrate_stick(const std::string& wanted, const std::filesystem::path& folder, bool again, int answers);

}  // namespace gearshift
