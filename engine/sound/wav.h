// Writes sound files that every player and browser can play.
#pragma once

#include <filesystem>
#include <span>

namespace gearshift::engine {

// Writes a 16-bit RIFF WAVE file. `stereo`: interleaved samples, clipped to [-1, 1]. `rate` [Hz]. Throws
// std::runtime_error with file and reason.
void write_wav(const std::filesystem::path& path, std::span<const float> stereo, int rate);

}  // namespace gearshift::engine
