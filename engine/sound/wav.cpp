// This work is based on:
// IBM, Microsoft. Multimedia Programming Interface and Data Specifications 1.0. 1991: RIFF, WAVE_FORMAT_PCM
#include "engine/sound/wav.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>

namespace gearshift::engine {

namespace {

// Appends the lowest `count` bytes of value, little-endian on every machine.
void append_integer(std::string& bytes, std::uint32_t value, int count) {
  for (int n = 0; n < count; ++n) bytes.push_back(static_cast<char>(value >> (8 * n) & 0xffu));
}

std::string header(std::uint32_t data_bytes, std::uint32_t rate) {
  constexpr std::uint32_t kChannels = 2, kBits = 16, kFrameBytes = kChannels * kBits / 8;
  std::string bytes = "RIFF";
  append_integer(bytes, 36 + data_bytes, 4);
  bytes += "WAVEfmt ";
  append_integer(bytes, 16, 4);
  append_integer(bytes, 1, 2);  // PCM
  append_integer(bytes, kChannels, 2);
  append_integer(bytes, rate, 4);
  append_integer(bytes, rate * kFrameBytes, 4);
  append_integer(bytes, kFrameBytes, 2);
  append_integer(bytes, kBits, 2);
  bytes += "data";
  append_integer(bytes, data_bytes, 4);
  return bytes;
}

std::uint32_t sample_16(float sample) {
  const float clipped = std::isnan(sample) ? 0.0f : std::clamp(sample, -1.0f, 1.0f);
  return static_cast<std::uint32_t>(std::lround(clipped * 32767.0f));
}

}  // namespace

void write_wav(const std::filesystem::path& path, std::span<const float> stereo, int rate) {
  if (stereo.size() % 2 != 0 || stereo.size() > 0x7fffff00u / 2 || rate <= 0) {
    throw std::runtime_error(path.string() + ": the sound is not stereo, or too long for a WAVE file");
  }
  std::string bytes = header(static_cast<std::uint32_t>(stereo.size() * 2), static_cast<std::uint32_t>(rate));
  bytes.reserve(bytes.size() + stereo.size() * 2);
  for (const float sample : stereo) append_integer(bytes, sample_16(sample), 2);
  // Writes a temporary file and renames it, so that a full disk leaves the old file intact.
  const std::filesystem::path part = path.string() + "." + std::to_string(getpid()) + ".part";
  std::ofstream file(part, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  std::error_code problem(file ? 0 : errno, std::generic_category());
  if (!problem) std::filesystem::rename(part, path, problem);
  if (!problem) return;
  std::error_code ignored;
  std::filesystem::remove(part, ignored);
  throw std::runtime_error(path.string() + ": cannot be written (" + problem.message() + ")");
}

}  // namespace gearshift::engine
