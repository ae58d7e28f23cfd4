// Text files about failed cases. Each lies beside the trace of its case, with the trace's name and the extension .txt.
// It lists the broken laws, the time and size of each violation, and the command that replays it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "app/lab/campaign/campaign_summary.h"

namespace gearshift::lab {

// Writes the text file, or deletes it if `broken` is empty. Throws FileError.
void write_broken_laws(const std::filesystem::path& trace, std::uint64_t campaign_seed,
                       std::span<const BrokenLaw> broken);

// Returns the text for this trace, with the trace's full path in the commands. Returns an empty string if the text file
// does not exist or names a different trace.
std::string broken_laws_text(const std::filesystem::path& trace);

}  // namespace gearshift::lab
