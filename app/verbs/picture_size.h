// Parses a picture size like "1280x720" from the command line.
#pragma once

#include <charconv>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

namespace gearshift::verbs {

inline constexpr int kMinPictureSide = 16, kMaxPictureSide = 8192;  // [px]

struct PictureSize {
  int width = 0, height = 0;  // [px]
};

// With `stereo`, the width must be even, because each eye gets half of it. Throws CLI::ValidationError.
inline PictureSize picture_size(const std::string& text, bool stereo) {
  PictureSize size;
  const char* const end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size.width);
  const bool has_x = width.ec == std::errc{} && width.ptr != end && *width.ptr == 'x';
  const auto height = has_x ? std::from_chars(width.ptr + 1, end, size.height) : width;
  const auto fits = [](int side) { return side >= kMinPictureSide && side <= kMaxPictureSide; };
  if (!has_x || height.ec != std::errc{} || height.ptr != end || !fits(size.width) || !fits(size.height))
    throw CLI::ValidationError(fmt::format("--size {}: must be WIDTHxHEIGHT, each from {} to {} pixels", text,
                                           kMinPictureSide, kMaxPictureSide));
  if (stereo && size.width % 2 != 0)
    throw CLI::ValidationError(
        fmt::format("--size {}: the width must be even, because the picture shows two eyes side by side", text));
  return size;
}

}  // namespace gearshift::verbs
