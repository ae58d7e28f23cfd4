#include "engine/image/image.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <stdexcept>

namespace gearshift::engine {

Image side_by_side(const Image& left, const Image& right) {
  if (left.height != right.height) throw std::invalid_argument("side_by_side: the images differ in height");
  Image both{left.width + right.width, left.height, {}};
  both.rgba.reserve(left.rgba.size() + right.rgba.size());
  for (int row = 0; row < left.height; ++row) {
    both.rgba.insert(both.rgba.end(), left.pixel(0, row), left.pixel(0, row) + 4L * left.width);
    both.rgba.insert(both.rgba.end(), right.pixel(0, row), right.pixel(0, row) + 4L * right.width);
  }
  return both;
}

ImageDifference difference(const Image& a, const Image& b, int tolerance) {
  if (a.width != b.width || a.height != b.height) throw std::invalid_argument("difference: the images differ in size");
  ImageDifference result;
  double squares = 0.0;
  std::size_t beyond = 0;
  for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
    int worst = 0;
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const int step = std::abs(a.rgba[i + channel] - b.rgba[i + channel]);
      squares += step * step;
      worst = std::max(worst, step);
    }
    result.worst = std::max(result.worst, worst);
    if (worst > tolerance) ++beyond;
  }
  const double pixels = std::max(1.0, static_cast<double>(a.rgba.size()) / 4.0);
  result.fraction_beyond = static_cast<double>(beyond) / pixels;
  result.psnr = squares == 0.0 ? std::numeric_limits<double>::infinity()
                               : 10.0 * std::log10(255.0 * 255.0 * 3.0 * pixels / squares);
  return result;
}

}  // namespace gearshift::engine
