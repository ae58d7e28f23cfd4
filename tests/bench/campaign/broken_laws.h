// What stands beside the trace of a case that broke a law, in a text of the trace's name: which, where, by how much, and the
// command that shows it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "tests/bench/campaign/campaign_summary.h"

namespace gearshift {

// None broken: no text is there any more. Throws FileError.
void tell_broken(const std::filesystem::path& trace, std::uint64_t campaign_seed, std::span<const LawBroken> broken);

// What the text says of this trace, its commands with the trace's whole path; empty where it names another one, or none.
std::string told_of(const std::filesystem::path& trace);

}  // namespace gearshift
