// Reads WAVE files back according to the format's definition.
#include "engine/sound/wav.h"

#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tests/support/temp_folder.h"

using namespace gearshift::engine;
using namespace gearshift::test;

namespace {

std::filesystem::path temporary_path() {
  return std::filesystem::temp_directory_path() / ("gearshift_wav_" + std::to_string(getpid()) + ".wav");
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

long number(const std::string& bytes, std::size_t at, int count) {
  long value = 0;
  for (int n = count - 1; n >= 0; --n)
    value = value * 256 + static_cast<unsigned char>(bytes[at + static_cast<std::size_t>(n)]);
  return value;
}

}  // namespace

TEST_CASE("a WAVE file has a correct header, and samples to half a 16-bit step, clipped at full scale") {
  std::vector<float> stereo;
  for (int n = 0; n < 1000; ++n) stereo.push_back(static_cast<float>(std::sin(0.01 * n * n)));
  for (const float special : {1.5f, -3.0f, std::numeric_limits<float>::quiet_NaN(), 0.0f}) stereo.push_back(special);
  const std::filesystem::path path = temporary_path();
  write_wav(path, stereo, 44100);
  const std::string bytes = bytes_of(path);
  std::filesystem::remove(path);
  REQUIRE(bytes.size() == 44 + 2 * stereo.size());
  CHECK(bytes.substr(0, 4) == "RIFF");
  CHECK(number(bytes, 4, 4) == static_cast<long>(bytes.size()) - 8);
  CHECK(bytes.substr(8, 8) == "WAVEfmt ");
  CHECK(number(bytes, 16, 4) == 16);
  CHECK(number(bytes, 20, 2) == 1);
  CHECK(number(bytes, 22, 2) == 2);
  CHECK(number(bytes, 24, 4) == 44100);
  CHECK(number(bytes, 28, 4) == 44100 * 4);
  CHECK(number(bytes, 32, 2) == 4);
  CHECK(number(bytes, 34, 2) == 16);
  CHECK(bytes.substr(36, 4) == "data");
  CHECK(number(bytes, 40, 4) == static_cast<long>(2 * stereo.size()));
  const auto sample = [&](std::size_t n) { return static_cast<std::int16_t>(number(bytes, 44 + 2 * n, 2)); };
  for (std::size_t n = 0; n < 1000; ++n) REQUIRE(std::abs(sample(n) / 32767.0 - stereo[n]) <= 0.5 / 32767.0 + 1e-7);
  CHECK(sample(1000) == 32767);
  CHECK(sample(1001) == -32767);
  CHECK(sample(1002) == 0);
}

TEST_CASE("a file that cannot be written throws one sentence that names it") {
  const std::vector<float> frame = {0.0f, 0.0f};
  CHECK_THROWS_AS(write_wav("/nonexistent/a.wav", frame, 48000), std::runtime_error);
  CHECK_THROWS_WITH(write_wav("/nonexistent/a.wav", frame, 48000),
                    "/nonexistent/a.wav: cannot be written (No such file or directory)");
  CHECK_THROWS_AS(write_wav(temporary_path(), std::span(frame).first(1), 48000), std::runtime_error);
  CHECK_THROWS_AS(write_wav(temporary_path(), frame, 0), std::runtime_error);
}

TEST_CASE("a failed write leaves the old file and no temporary file") {
  const TempFolder folder;
  std::filesystem::create_directories(folder / "a.wav/kept");
  CHECK_THROWS_AS(write_wav(folder / "a.wav", std::vector<float>(2), 48000), std::runtime_error);
  CHECK(std::filesystem::exists(folder / "a.wav/kept"));
  CHECK(std::distance(std::filesystem::directory_iterator(folder / ""), {}) == 1);
}
