// Writes, reads, joins and compares images, and reads files that are not images.
#include "engine/image/image.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>

#include <doctest/doctest.h>

#include "tests/support/pictures.h"
#include "tests/support/temp_folder.h"

using namespace gearshift::engine;
using namespace gearshift::test;
using doctest::Approx;

namespace {

Image noise(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  Image image{width, height, std::vector<std::uint8_t>(4 * static_cast<std::size_t>(width * height))};
  for (std::uint8_t& byte : image.rgba) byte = static_cast<std::uint8_t>(random());
  return image;
}

// Each pixel stores its x, its y and the number of the picture.
Image numbered(int width, int height, std::uint8_t picture = 0) {
  Image image = noise(width, height, 1);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.pixel(x, y)[0] = static_cast<std::uint8_t>(x);
      image.pixel(x, y)[1] = static_cast<std::uint8_t>(y);
      image.pixel(x, y)[2] = picture;
    }
  }
  return image;
}

std::vector<std::uint8_t> file_bytes(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::uint32_t big_endian(const std::vector<std::uint8_t>& bytes, std::size_t at) {
  return std::uint32_t{bytes[at]} << 24 | std::uint32_t{bytes[at + 1]} << 16 | std::uint32_t{bytes[at + 2]} << 8 |
         bytes[at + 3];
}

// Returns the message (one sentence) of the exception that `act` throws.
template <typename Act>
std::string rejection(Act act) {
  try {
    act();
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a picture is identical after writing and reading, alpha included") {
  TempFolder folder;
  const std::pair<int, int> sizes[] = {{1, 1}, {3, 7}, {64, 48}, {1, 300}};
  for (const auto& [width, height] : sizes) {
    const Image image = noise(width, height, 5);
    write_png(folder / "image.png", image);
    const Image back = read_png(folder / "image.png");
    CHECK(back.width == width);
    CHECK(back.height == height);
    CHECK(back.rgba == image.rgba);
  }
}

TEST_CASE("the file is a standard PNG: signature, size, eight bits of RGBA") {
  TempFolder folder;
  write_png(folder / "image.png", noise(5, 3, 2));
  const std::vector<std::uint8_t> bytes = file_bytes(folder / "image.png");
  REQUIRE(bytes.size() > 33);
  CHECK(big_endian(bytes, 0) == 0x89504e47);
  CHECK(big_endian(bytes, 12) == 0x49484452);  // IHDR
  CHECK(big_endian(bytes, 16) == 5);
  CHECK(big_endian(bytes, 20) == 3);
  CHECK(bytes[24] == 8);
  CHECK(bytes[25] == 6);
}

TEST_CASE("links and pipes are kept: their target is written") {
  namespace fs = std::filesystem;
  TempFolder folder;
  const Image first = noise(4, 4, 1), second = noise(5, 5, 2);
  write_png(folder / "image.png", first);
  fs::create_symlink("image.png", folder / "link.png");
  write_png(folder / "link.png", second);
  CHECK(fs::is_symlink(folder / "link.png"));
  CHECK(read_png(folder / "image.png").rgba == second.rgba);
  const fs::path pipe = folder / "pipe";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  REQUIRE(reader >= 0);
  write_png(pipe, second);
  CHECK(fs::is_fifo(pipe));
  std::vector<std::uint8_t> got(2 * fs::file_size(folder / "image.png"));
  CHECK(read(reader, got.data(), got.size()) == static_cast<ssize_t>(fs::file_size(folder / "image.png")));
  close(reader);
  CHECK(std::distance(fs::directory_iterator(folder.path()), {}) == 3);
}

TEST_CASE("a write replaces the file and leaves no other file; a failed write leaves the old picture") {
  TempFolder folder;
  const Image first = noise(4, 4, 1), second = noise(5, 5, 2);
  write_png(folder / "image.png", first);
  write_png(folder / "image.png", second);
  CHECK(read_png(folder / "image.png").rgba == second.rgba);
  CHECK_THROWS_AS(write_png(folder / "image.png", Image{2, 2, {1, 2, 3}}), std::runtime_error);
  CHECK(read_png(folder / "image.png").rgba == second.rgba);
  CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 1);
  const std::string reason = rejection([&] { write_png(folder / "none" / "image.png", first); });
  CHECK(reason.starts_with((folder / "none" / "image.png").string() + ": "));
  CHECK(reason.find("No such file") != std::string::npos);
  std::filesystem::create_directory(folder / "taken.png");
  CHECK_FALSE(rejection([&] { write_png(folder / "taken.png", first); }).empty());
  CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 2);
}

TEST_CASE("bytes that are not a whole picture are rejected with one reason") {
  TempFolder folder;
  write_png(folder / "good.png", noise(8, 8, 3));
  const std::vector<std::uint8_t> good = file_bytes(folder / "good.png");
  std::vector<std::uint8_t> huge = good;
  huge[16] = huge[20] = 0x7f;
  const std::vector<std::uint8_t> files[] = {{},
                                             {'n', 'o'},
                                             {0xff, 0xd8, 0xff, 0xe0},
                                             {good.begin(), good.begin() + 8},
                                             {good.begin(), good.begin() + 30},
                                             {good.begin(), good.end() - 40},
                                             huge};
  for (const std::vector<std::uint8_t>& bytes : files) {
    const std::string reason = rejection([&] { decode_image(bytes); });
    CAPTURE(reason);
    CHECK_FALSE(reason.empty());
    CHECK(reason.find('\n') == std::string::npos);
  }
}

TEST_CASE("the size of an encoded picture is known without its pixels") {
  TempFolder folder;
  write_png(folder / "good.png", noise(9, 4, 3));
  std::vector<std::uint8_t> bytes = file_bytes(folder / "good.png");
  bytes.resize(45);  // keeps only the header and the start of the data
  CHECK(encoded_size(bytes).width == 9);
  CHECK(encoded_size(bytes).height == 4);
  CHECK_THROWS_AS(decode_image(bytes), std::runtime_error);
}

TEST_CASE("two images are placed side by side, the left one on the left") {
  const Image left = numbered(3, 5, 100), right = numbered(4, 5, 200);
  const Image both = side_by_side(left, right);
  REQUIRE(both.width == 7);
  CHECK(crop(both, 0, 0, 3, 5).rgba == left.rgba);
  CHECK(crop(both, 3, 0, 4, 5).rgba == right.rgba);
  CHECK_THROWS_AS(side_by_side(left, numbered(3, 4)), std::invalid_argument);
}

TEST_CASE("the difference between pictures: none, a known error, the fraction beyond the tolerance") {
  const Image image = noise(10, 10, 4);
  const ImageDifference none = difference(image, image);
  CHECK(none.psnr == std::numeric_limits<double>::infinity());
  CHECK(none.fraction_beyond == 0.0);
  CHECK(none.worst == 0);

  Image grey{10, 10, std::vector<std::uint8_t>(400, 100)}, off = grey;
  for (std::size_t i = 0; i < 400; ++i)
    off.rgba[i] = static_cast<std::uint8_t>(i % 4 == 3 ? 7 : 105);  // alpha must be ignored
  CHECK(difference(grey, off).psnr == Approx(20.0 * std::log10(255.0 / 5.0)));
  CHECK(difference(grey, off).worst == 5);
  CHECK(difference(grey, off).fraction_beyond == 1.0);
  CHECK(difference(grey, off, 5).fraction_beyond == 0.0);

  Image one = grey;
  one.pixel(3, 4)[1] = 96;
  CHECK(difference(grey, one).fraction_beyond == Approx(0.01));
  CHECK(difference(one, grey).worst == 4);
  CHECK(difference(grey, one).psnr == Approx(10.0 * std::log10(255.0 * 255.0 * 300.0 / 16.0)));
  CHECK_THROWS_AS(difference(grey, noise(10, 11, 1)), std::invalid_argument);
}
