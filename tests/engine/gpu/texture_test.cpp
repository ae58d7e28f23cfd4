#include <array>
#include <cmath>
#include <cstring>
#include <random>
#include <stdexcept>

#include <doctest/doctest.h>

#include "engine/gpu/commands.h"
#include "engine/gpu/gpu_buffer.h"
#include "engine/gpu/gpu_image.h"
#include "tests/support/gpu_fixture.h"

using namespace gearshift::engine;
using namespace gearshift::test;

namespace {

Image noise(int width, int height) {
  Image image{.width = width, .height = height, .rgba = {}};
  std::mt19937 random(11);
  for (int i = 0; i < width * height * 4; ++i) image.rgba.push_back(static_cast<std::uint8_t>(random() % 256));
  return image;
}

// Reads the bytes of one level of one layer.
std::vector<std::uint8_t> level_bytes(Gpu& gpu, GpuImage& image, std::uint32_t level, std::uint32_t layer,
                                      std::size_t texel_size) {
  const std::uint32_t width = std::max(image.desc().width >> level, 1u);
  const std::uint32_t height = std::max(image.desc().height >> level, 1u);
  std::vector<std::uint8_t> bytes(texel_size * width * height);
  const GpuBuffer buffer(gpu, bytes.size(), VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryKind::read_back);
  run_once(gpu, [&](VkCommandBuffer commands) {
    transition(commands, image, ImageUse::copy_from);
    const VkBufferImageCopy copy{.imageSubresource = {.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT,
                                                      .mipLevel = level,
                                                      .baseArrayLayer = layer,
                                                      .layerCount = 1},
                                 .imageExtent = {width, height, 1}};
    vkCmdCopyImageToBuffer(commands, image.get(), layout_of(ImageUse::copy_from), buffer.get(), 1, &copy);
  });
  std::memcpy(bytes.data(), buffer.mapped(), bytes.size());
  return bytes;
}

// IEC 61966-2-1
double to_linear(double s) {
  return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}
double to_srgb(double l) {
  return l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1.0 / 2.4) - 0.055;
}

// Mean (0 to 255) of the four texels in the next larger level; the colours of an sRGB format are averaged in linear
// light.
double box(const std::vector<std::uint8_t>& above, std::size_t width, std::size_t x, std::size_t y, std::size_t channel,
           bool srgb) {
  double sum = 0.0;
  for (const std::size_t i : {0u, 1u, 2u, 3u}) {
    const double value = above[4 * ((2 * y + i / 2) * width + 2 * x + i % 2) + channel] / 255.0;
    sum += srgb && channel < 3 ? to_linear(value) : value;
  }
  return 255.0 * (srgb && channel < 3 ? to_srgb(sum / 4) : sum / 4);
}

}  // namespace

TEST_CASE("a picture uploaded and read back has the same bytes, sRGB or not") {
  GpuFixture fixture;
  const Image picture = noise(61, 37);
  for (const bool srgb : {false, true}) {
    GpuImage texture = make_texture(fixture.gpu(), picture, srgb, false);
    CHECK(texture.use() == ImageUse::sampled);
    CHECK(texture.desc().levels == 1);
    const Image back = read_back(fixture.gpu(), texture);
    CHECK(texture.use() == ImageUse::copy_from);
    CHECK(back.width == 61);
    CHECK(back.height == 37);
    CHECK(back.rgba == picture.rgba);
  }
}

TEST_CASE("each mip level, down to one texel, is the box average of the next larger one, in linear light for sRGB") {
  GpuFixture fixture;
  Gpu& gpu = fixture.gpu();
  for (const bool srgb : {false, true}) {
    GpuImage texture = make_texture(gpu, noise(64, 32), srgb, true);
    REQUIRE(texture.desc().levels == 7);
    double worst = 0.0;
    for (std::uint32_t level = 1; level < 6; ++level) {  // not level 6, whose only texel is the mean of two
      const auto above = level_bytes(gpu, texture, level - 1, 0, 4), current = level_bytes(gpu, texture, level, 0, 4);
      const std::size_t width = 64u >> level, height = 32u >> level;
      for (std::size_t i = 0; i < width * height * 4; ++i) {
        const std::size_t x = i / 4 % width, y = i / 4 / width;
        worst = std::max(worst, std::abs(current[i] - box(above, 2 * width, x, y, i % 4, srgb)));
      }
    }
    CHECK(worst < 1.01);  // allows an error of one, because the driver rounds down
    CHECK(level_bytes(gpu, texture, 6, 0, 4).size() == 4);
  }
}

TEST_CASE("an sRGB mip of black and white has half the light, 188, not half the value") {
  GpuFixture fixture;
  Image board{.width = 2, .height = 2, .rgba = {}};
  for (const std::uint8_t v : std::array<std::uint8_t, 4>{255, 0, 0, 255}) {
    board.rgba.insert(board.rgba.end(), {v, v, v, 255});
  }
  GpuImage light = make_texture(fixture.gpu(), board, true, true);
  GpuImage code = make_texture(fixture.gpu(), board, false, true);
  CHECK(std::abs(level_bytes(fixture.gpu(), light, 1, 0, 4)[0] - 188) <= 1);
  CHECK(std::abs(level_bytes(fixture.gpu(), code, 1, 0, 4)[0] - 128) <= 1);
}

TEST_CASE("raw texels reach their level and layer: a cube of half floats, a table of two channels") {
  GpuFixture fixture;
  Gpu& gpu = fixture.gpu();
  std::vector<std::vector<std::byte>> cube;
  for (const std::size_t side : {4u, 2u, 1u}) {
    std::vector<std::byte> level(6 * side * side * 8);
    for (std::size_t i = 0; i < level.size(); ++i) level[i] = static_cast<std::byte>((i * 7 + side) % 100);
    cube.push_back(level);
  }
  GpuImage image = make_texture(
      gpu, {.width = 4, .height = 4, .layers = 6, .levels = 3, .format = VK_FORMAT_R16G16B16A16_SFLOAT, .cube = true},
      cube);
  CHECK(image.use(2) == ImageUse::sampled);
  const ImageView view = make_view(gpu, image, VK_IMAGE_VIEW_TYPE_CUBE, 0, 6);
  CHECK(view);
  for (std::uint32_t level = 0; level < 3; ++level) {
    const std::size_t face = std::size_t{8} * (4u >> level) * (4u >> level);
    for (std::uint32_t layer = 0; layer < 6; ++layer) {
      const auto bytes = level_bytes(gpu, image, level, layer, 8);
      CHECK(bytes.size() == face);
      CHECK(std::memcmp(bytes.data(), cube[level].data() + layer * face, face) == 0);
    }
  }
  const std::vector<std::vector<std::byte>> one{std::vector<std::byte>(36, std::byte{9})};
  GpuImage table = make_texture(gpu, {.width = 3, .height = 3, .format = VK_FORMAT_R16G16_UNORM}, one);
  CHECK(level_bytes(gpu, table, 0, 0, 4) == std::vector<std::uint8_t>(36, 9));
  CHECK_THROWS_AS(make_texture(gpu, {.levels = 2}, one), std::logic_error);
}

TEST_CASE("read_back() reads the requested layer") {
  GpuFixture fixture;
  std::vector<std::vector<std::byte>> one_level{std::vector<std::byte>(32, std::byte{1})};
  std::fill(one_level[0].begin() + 16, one_level[0].end(), std::byte{2});
  GpuImage image = make_texture(fixture.gpu(),
                                {.width = 2, .height = 2, .layers = 2, .format = VK_FORMAT_R8G8B8A8_UNORM}, one_level);
  CHECK(read_back(fixture.gpu(), image, 0).rgba == std::vector<std::uint8_t>(16, 1));
  CHECK(read_back(fixture.gpu(), image, 1).rgba == std::vector<std::uint8_t>(16, 2));
}

TEST_CASE("one image can be viewed as sRGB and as UNORM") {
  GpuFixture fixture;
  const GpuImage image(fixture.gpu(), {.width = 8,
                                       .height = 8,
                                       .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT,
                                       .second_format = VK_FORMAT_R8G8B8A8_UNORM});
  CHECK(make_view(fixture.gpu(), image, VK_IMAGE_VIEW_TYPE_2D));
  CHECK(make_view(fixture.gpu(), image, VK_IMAGE_VIEW_TYPE_2D, 0, 1, VK_FORMAT_R8G8B8A8_UNORM));
}
