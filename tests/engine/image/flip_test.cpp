// Checks the picture metric FLIP against its own properties, and against its authors' program.
#include "engine/image/flip.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <doctest/doctest.h>

using namespace gearshift::engine;
using doctest::Approx;

namespace {

Image plain(int width, int height, std::uint8_t r, std::uint8_t g, std::uint8_t b) {
  Image image{width, height, {}};
  for (int i = 0; i < width * height; ++i) image.rgba.insert(image.rgba.end(), {r, g, b, 255});
  return image;
}

// A test picture of ramps, a chequered corner and a disc: smooth areas, fine detail and edges.
Image scene(int shift, int tint) {
  Image image = plain(96, 64, 0, 0, 0);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 96; ++x) {
      const int u = x + shift;
      int r = 2 * u, g = 4 * y, b = 255 - 2 * u;
      if (u < 32 && y < 32 && (u / 2 + y / 2) % 2 == 0) r = g = b = 230;
      if ((u - 60) * (u - 60) + (y - 30) * (y - 30) < 200) r = 20, g = 60, b = 200;
      const int colour[3] = {r + tint, g, b - tint};
      for (int i = 0; i < 3; ++i) image.pixel(x, y)[i] = static_cast<std::uint8_t>(std::clamp(colour[i], 0, 255));
    }
  }
  return image;
}

// Error between two uniform pictures, to which FLIP's filters and feature detection contribute nothing.
double plain_error(const Image& a, const Image& b) {
  const FlipError error = flip(a, b);
  for (const double e : error.map) CHECK(e == Approx(error.mean).epsilon(1e-9));
  return error.mean;
}

}  // namespace

TEST_CASE("a picture does not differ from itself, and alpha makes no difference") {
  const Image image = scene(0, 0);
  Image clear = image;
  for (std::size_t i = 3; i < clear.rgba.size(); i += 4) clear.rgba[i] = 7;
  CHECK(flip(image, clear).mean == 0.0);
  CHECK(flip(image, image).map.size() == 96 * 64);
}

TEST_CASE(
    "green against blue has the largest error, 1, and black against white has the value of the paper's formulas") {
  const Image black = plain(40, 30, 0, 0, 0), white = plain(40, 30, 255, 255, 255);
  const Image green = plain(40, 30, 0, 255, 0), blue = plain(40, 30, 0, 0, 255);
  CHECK(plain_error(green, blue) == Approx(1.0).epsilon(1e-6));
  // The HyAB distance is 100 between black and white, and 203.3 between Hunt-adjusted green (87.735, -75.61, 72.97) and
  // blue (32.297, 25.58, -34.84). The paper raises distances to the power 0.7, and then maps the lowest 0.4 of the range
  // to [0, 0.95] and the rest to [0.95, 1].
  const double max_distance = std::pow(203.30, 0.7), error = std::pow(100.0, 0.7);
  const double expected = 0.95 + 0.05 * (error - 0.4 * max_distance) / (0.6 * max_distance);
  CHECK(plain_error(black, white) == Approx(expected).epsilon(1e-4));
}

TEST_CASE("the order of the pictures does not matter, and every error is between 0 and 1") {
  const Image a = scene(0, 0), b = scene(2, 30);
  const FlipError one = flip(a, b), other = flip(b, a);
  CHECK(one.mean == Approx(other.mean).epsilon(1e-12));
  for (const double e : one.map) CHECK((e >= 0.0 && e <= 1.0));
  CHECK_THROWS_AS(flip(a, plain(96, 63, 0, 0, 0)), std::invalid_argument);
}

TEST_CASE("a larger difference gives a larger error, and a greater viewing distance hides fine differences") {
  const Image image = scene(0, 0);
  CHECK(flip(image, scene(0, 10)).mean < flip(image, scene(0, 40)).mean);
  CHECK(flip(image, scene(1, 0)).mean < flip(image, scene(4, 0)).mean);
  // A chequerboard of single pixels looks from far away like uniform grey.
  Image chequer = plain(64, 64, 255, 255, 255);
  for (int y = 0; y < 64; ++y) {
    for (int x = y % 2; x < 64; x += 2) std::fill_n(chequer.pixel(x, y), 3, std::uint8_t{0});
  }
  const Image grey = plain(64, 64, 188, 188, 188);  // half the light
  CHECK(flip(chequer, grey, 67.0).mean < 0.7 * flip(chequer, grey, 15.0).mean);
}

TEST_CASE("the authors' program gives the same means") {
  // The expected values are from FLIP.h 1.6 (github.com/NVlabs/flip, LDR), computed for these pictures. FLIP.h uses
  // single precision; its error differs from ours by less than 1e-4 in each pixel.
  CHECK(flip(scene(0, 0), scene(1, 0)).mean == Approx(0.082336).epsilon(1e-4));
  CHECK(flip(scene(0, 0), scene(0, 25)).mean == Approx(0.318675).epsilon(1e-4));
  CHECK(flip(scene(0, 0), scene(3, 60)).mean == Approx(0.645464).epsilon(1e-4));
  CHECK(flip(scene(0, 0), scene(3, 60), 30.0).mean == Approx(0.662537).epsilon(1e-4));
}
