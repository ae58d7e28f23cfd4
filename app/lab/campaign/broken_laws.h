// Text files beside the traces of failed cases, with the trace's name and extension .txt: the broken laws, when and by
// how much they were broken, and the command that shows it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "app/lab/campaign/campaign_summary.h"

namespace gearshift::lab {

// Writes the text, or deletes it if no law is broken. Throws FileError.
void write_broken_laws(const std::filesystem::path& trace, std::uint64_t campaign_seed,
                       std::span<const BrokenLaw> broken);

// The lines of the text about this trace, with the trace's full path in the commands; empty if the text names a
// different trace or does not exist.
std::string broken_laws_text(const std::filesystem::path& trace);

}  // namespace gearshift::lab
