// An image in memory, PNG files, and the difference between two images.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace gearshift::engine {

struct Image {
  int width = 0;                   // [px]
  int height = 0;                  // [px]
  std::vector<std::uint8_t> rgba;  // sRGB, 4 bytes per pixel, rows from the top

  const std::uint8_t* pixel(int x, int y) const noexcept {
    return rgba.data() + 4 * (static_cast<long>(y) * width + x);
  }
  std::uint8_t* pixel(int x, int y) noexcept { return rgba.data() + 4 * (static_cast<long>(y) * width + x); }
};

inline constexpr int kMaxImageSide = 16384;  // [px] limit for images that are read

// Replaces the file atomically. Throws std::runtime_error with one sentence that names file and reason.
void write_png(const std::filesystem::path& file, const Image& image);

// encoded_size() and decode_image() take the bytes of a PNG or JPEG file and reject other formats. They throw
// std::runtime_error with only the reason. encoded_size() reads only the header, so a caller can check the size before
// memory for the pixels is allocated.
struct ImageSize {
  int width = 0, height = 0;  // [px]
};
ImageSize encoded_size(std::span<const std::uint8_t> bytes);
Image decode_image(std::span<const std::uint8_t> bytes);

// Places two images of equal height next to each other, to show a stereo pair on a desktop. Throws
// std::invalid_argument if the heights differ.
Image side_by_side(const Image& left, const Image& right);

struct ImageDifference {
  double psnr = 0.0;             // [dB] over the colour channels; infinite if equal
  double fraction_beyond = 0.0;  // [1] fraction of pixels that differ by more than `tolerance` in some channel
  int worst = 0;                 // [1/255] largest difference in any channel
};
// Ignores alpha. `tolerance`: [1/255]. Throws std::invalid_argument if sizes differ.
ImageDifference difference(const Image& a, const Image& b, int tolerance = 3);

}  // namespace gearshift::engine
