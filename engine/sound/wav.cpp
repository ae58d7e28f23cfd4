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

// Little-endian on every machine.
void put(std::string& bytes, std::uint32_t value, int count) {
  for (int n = 0; n < count; ++n) bytes.push_back(static_cast<char>(value >> (8 * n) & 0xffu));
}

std::string header(std::uint32_t data_bytes, std::uint32_t rate) {
  constexpr std::uint32_t kChannels = 2, kBits = 16, kFrameBytes = kChannels * kBits / 8;
  std::string bytes = "RIFF";
  put(bytes, 36 + data_bytes, 4);
  bytes += "WAVEfmt ";
  put(bytes, 16, 4);
  put(bytes, 1, 2);  // PCM
  put(bytes, kChannels, 2);
  put(bytes, rate, 4);
  put(bytes, rate * kFrameBytes, 4);
  put(bytes, kFrameBytes, 2);
  put(bytes, kBits, 2);
  bytes += "data";
  put(bytes, data_bytes, 4);
  return bytes;
}

std::uint32_t sample_16(float sample) {
  const float clipped = std::isnan(sample) ? 0.0f : std::clamp(sample, -1.0f, 1.0f);
  return static_cast<std::uint32_t>(std::lround(clipped * 32767.0f));
}

}  // namespace

void write_wav(const std::filesystem::path& path, std::span<const float> stereo, int rate) {
  if (stereo.size() % 2 != 0 || stereo.size() > 0x7fffff00u / 2 || rate <= 0) {
    throw std::runtime_error(path.string() + ": not stereo, or too long for a WAVE file");
  }
  std::string bytes = header(static_cast<std::uint32_t>(stereo.size() * 2), static_cast<std::uint32_t>(rate));
  bytes.reserve(bytes.size() + stereo.size() * 2);
  for (const float sample : stereo) put(bytes, sample_16(sample), 2);
  // Written beside the old file and then renamed, so that a full disk leaves the old file intact.
  const std::filesystem::path part = path.string() + "." + std::to_string(getpid()) + ".part";
  std::ofstream file(part, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  std::error_code problem(file ? 0 : errno, std::generic_category());
  if (!problem) std::filesystem::rename(part, path, problem);
  if (!problem) return;
  std::error_code ignored;
  std::filesystem::remove(part, ignored);
  throw std::runtime_error(path.string() + ": cannot be written: " + problem.message());
}

}  // namespace gearshift::engine
