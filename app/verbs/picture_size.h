// "1280x720" on a command line.
#pragma once

#include <charconv>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

namespace gearshift {

inline constexpr int kLeastPictureSide = 16, kMostPictureSide = 8192;  // [px]

struct PictureSize {
  int width = 0, height = 0;  // [px]
};

// Throws CLI::ValidationError. stereo: two eyes of the same whole number of pixels stand side by side.
inline PictureSize picture_size(const std::string& text, bool stereo) {
  PictureSize size;
  const char* const end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size.width);
  const bool crossed = width.ec == std::errc{} && width.ptr != end && *width.ptr == 'x';
  const auto height = crossed ? std::from_chars(width.ptr + 1, end, size.height) : width;
  const auto fits = [](int side) { return side >= kLeastPictureSide && side <= kMostPictureSide; };
  if (!crossed || height.ec != std::errc{} || height.ptr != end || !fits(size.width) || !fits(size.height))
    throw CLI::ValidationError(fmt::format("--size {}: must be WIDTHxHEIGHT, each {} to {} pixels", text,
                                           kLeastPictureSide, kMostPictureSide));
  if (stereo && size.width % 2 != 0)
    throw CLI::ValidationError(fmt::format("--size {}: must be of even width for two eyes side by side", text));
  return size;
}

}  // namespace gearshift
