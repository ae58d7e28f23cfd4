// Reads pictures, and cuts parts out of them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <vector>

#include "engine/image/image.h"

namespace gearshift::test {

inline engine::Image read_png(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return engine::decode_image(std::vector<std::uint8_t>{std::istreambuf_iterator<char>(in), {}});
}

inline engine::Image crop(const engine::Image& image, int x, int y, int width, int height) {
  if (x < 0 || y < 0 || x + width > image.width || y + height > image.height) throw std::out_of_range("crop");
  engine::Image part{width, height, {}};
  for (int row = y; row < y + height; ++row)
    part.rgba.insert(part.rgba.end(), image.pixel(x, row), image.pixel(x, row) + 4L * width);
  return part;
}

}  // namespace gearshift::test
