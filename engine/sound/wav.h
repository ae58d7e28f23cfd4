// Sound as a file that every player and browser plays.
#pragma once

#include <filesystem>
#include <span>

namespace gearshift {

// Interleaved stereo in [-1, 1], clipped beyond, as 16-bit RIFF WAVE; rate in [Hz]. Throws std::runtime_error.
void write_wav(const std::filesystem::path& path, std::span<const float> stereo, int rate);

}  // namespace gearshift
