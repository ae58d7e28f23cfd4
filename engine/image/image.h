// A picture in memory, as PNG, and how far apart two of them are.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace gearshift {

struct Image {
  int width = 0;                   // [px]
  int height = 0;                  // [px]
  std::vector<std::uint8_t> rgba;  // sRGB, 4 bytes a pixel, rows from the top

  const std::uint8_t* pixel(int x, int y) const noexcept {
    return rgba.data() + 4 * (static_cast<long>(y) * width + x);
  }
  std::uint8_t* pixel(int x, int y) noexcept { return rgba.data() + 4 * (static_cast<long>(y) * width + x); }
};

inline constexpr int kMostImageSide = 16384;  // [px] of a picture that is read

// Throw std::runtime_error with one sentence: file and reason. A picture appears whole or not at all.
void write_png(const std::filesystem::path& file, const Image& image);
Image read_png(const std::filesystem::path& file);

// A PNG or JPEG file's bytes; no other kind is tried. Throw std::runtime_error with the reason alone. The size is read
// from the header: nothing is allocated for the pixels before the caller has judged it.
struct ImageSize {
  int width = 0, height = 0;  // [px]
};
ImageSize encoded_size(std::span<const std::uint8_t> bytes);
Image decode_image(std::span<const std::uint8_t> bytes);

// The part of an image inside the rectangle; the rectangle must lie inside it, or std::invalid_argument.
Image crop(const Image& image, int x, int y, int width, int height);

// Halves of one picture, for stereo on a desktop. Same height, or std::invalid_argument.
Image side_by_side(const Image& left, const Image& right);

struct ImageDifference {
  double psnr = 0.0;          // [dB] of the colour channels; infinite when equal
  double share_beyond = 0.0;  // [1] of the pixels that differ by more than `tolerance` in some channel
  int worst = 0;              // [1/255] largest difference of a channel
};
// Same size, or std::invalid_argument. Alpha is not compared. tolerance [1/255]
ImageDifference difference(const Image& a, const Image& b, int tolerance = 3);

}  // namespace gearshift
