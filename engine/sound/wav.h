// Writes sound files that every player and browser can play.
#pragma once

#include <filesystem>
#include <span>

namespace gearshift::engine {

// stereo: interleaved samples in [-1, 1], clipped if beyond; rate [Hz]. Writes 16-bit RIFF WAVE. Throws
// std::runtime_error.
void write_wav(const std::filesystem::path& path, std::span<const float> stereo, int rate);

}  // namespace gearshift::engine
