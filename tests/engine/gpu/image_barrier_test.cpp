#include <array>
#include <random>
#include <stdexcept>

#include <doctest/doctest.h>

#include "engine/gpu/gpu_buffer.h"
#include "engine/gpu/gpu_image.h"
#include "tests/engine/gpu/canvas.h"
#include "tests/support/gpu_fixture.h"

using namespace gearshift::engine;
using namespace gearshift::test;

namespace {

// The requirements of each use, from the specification (Vulkan 1.3, "Image Layouts" and table "Supported access
// types").
struct UseRequirement {
  ImageUse use;
  VkImageLayout layout;
  VkPipelineStageFlags2 stages;
  VkAccessFlags2 reads, writes;
};
constexpr std::array kUseRequirements{
    UseRequirement{ImageUse::colour_target, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                   VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT, VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT,
                   VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT},
    UseRequirement{ImageUse::depth_target, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
                   VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
                   VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT, VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT},
    UseRequirement{ImageUse::sampled, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
                   VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, 0},
    UseRequirement{ImageUse::copy_from, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                   VK_ACCESS_2_TRANSFER_READ_BIT, 0},
    UseRequirement{ImageUse::copy_to, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, 0,
                   VK_ACCESS_2_TRANSFER_WRITE_BIT},
    UseRequirement{ImageUse::present, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, 0, 0},
};
constexpr VkImageAspectFlags kColour = VK_IMAGE_ASPECT_COLOR_BIT;

}  // namespace

TEST_CASE("a barrier between two uses flushes writes, waits for reads and sets the new layout") {
  for (const UseRequirement& from : kUseRequirements) {
    for (const UseRequirement& to : kUseRequirements) {
      const auto barrier = barrier_between(from.use, to.use, kColour);
      CHECK(barrier.has_value() == (from.use != to.use || to.writes != 0));
      if (!barrier) continue;
      CHECK(barrier->oldLayout == from.layout);
      CHECK(barrier->newLayout == to.layout);
      CHECK(barrier->srcStageMask == from.stages);
      CHECK(barrier->srcAccessMask == from.writes);
      CHECK(barrier->dstStageMask == to.stages);
      CHECK(barrier->dstAccessMask == (to.reads | to.writes));
      CHECK(barrier->subresourceRange.aspectMask == kColour);
    }
  }
}

TEST_CASE("a new image waits for all earlier work, a discarded image for its last use; both drop the content") {
  for (const UseRequirement& to : kUseRequirements) {
    const auto fresh = barrier_between(ImageUse::none, to.use, kColour);
    REQUIRE(fresh.has_value());
    CHECK(fresh->oldLayout == VK_IMAGE_LAYOUT_UNDEFINED);
    CHECK(fresh->srcStageMask == VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT);
    CHECK(fresh->srcAccessMask == VK_ACCESS_2_MEMORY_WRITE_BIT);
    for (const UseRequirement& last : kUseRequirements) {
      const auto discarded = barrier_between(ImageUse::none, to.use, kColour, last.use);
      REQUIRE(discarded.has_value());
      CHECK(discarded->oldLayout == VK_IMAGE_LAYOUT_UNDEFINED);
      CHECK(discarded->srcStageMask == last.stages);
      CHECK(discarded->srcAccessMask == last.writes);
      CHECK(discarded->newLayout == to.layout);
    }
  }
  CHECK_THROWS_AS(barrier_between(ImageUse::sampled, ImageUse::none, kColour), std::logic_error);
}

TEST_CASE("an image tracks its use per mip level, and a wrong use throws with both names") {
  GpuFixture fixture;
  Gpu& gpu = fixture.gpu();
  GpuImage image(
      gpu,
      {.width = 16, .height = 16, .levels = 3, .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT});
  CHECK_NOTHROW(expect(image, ImageUse::none));
  run_once(gpu, [&](VkCommandBuffer commands) {
    transition(commands, image, ImageUse::copy_to);
    transition(commands, image, ImageUse::sampled, 1, 1);
    CHECK_THROWS_AS(transition(commands, image, ImageUse::sampled, 2, 2), std::logic_error);
  });
  CHECK_NOTHROW(expect(image, ImageUse::copy_to, 0));
  CHECK_NOTHROW(expect(image, ImageUse::sampled, 1));
  CHECK_NOTHROW(expect(image, ImageUse::copy_to, 2));
  CHECK_THROWS_WITH_AS(expect(image, ImageUse::sampled), "An image is used as sampled but is in state copy_to.",
                       std::logic_error);
  discard_content(image);
  for (const std::uint32_t level : {0u, 1u, 2u}) CHECK(image.use(level) == ImageUse::none);
}

TEST_CASE("a moved image keeps its state, and the source is empty") {
  GpuFixture fixture;
  Gpu& gpu = fixture.gpu();
  Canvas canvas(gpu, 4, 4);
  run_once(gpu, [&](VkCommandBuffer commands) { canvas.draw(commands, {}); });
  VkImage raw = canvas.colour.get();
  GpuImage moved = std::move(canvas.colour);
  CHECK(moved.get() == raw);
  CHECK(moved.use() == ImageUse::colour_target);
  const VkDeviceSize before = gpu.allocated();
  moved = GpuImage();
  CHECK(gpu.allocated() < before);
}

// Random operations in frames in flight, on images that are copied, cleared, drawn to and discarded. Validation reports
// missing barriers. The bytes are checked too, because a barrier that orders the wrong accesses may change them.
TEST_CASE("any sequence of uses keeps validation silent and the content correct") {
  GpuFixture fixture;
  Gpu& gpu = fixture.gpu();
  constexpr std::uint32_t side = 64;
  std::array<Canvas, 2> canvases{Canvas(gpu, side, side), Canvas(gpu, side, side)};
  constexpr VkDeviceSize picture_bytes = VkDeviceSize{4} * side * side;
  GpuBuffer grey(gpu, 256 * picture_bytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, MemoryKind::upload);
  for (VkDeviceSize i = 0; i < grey.size(); ++i) grey.mapped()[i] = static_cast<std::byte>(i / picture_bytes);
  std::array<int, 2> value{0, 0};
  std::mt19937 random(7);
  FrameRing ring(gpu);
  run_once(gpu, [&](VkCommandBuffer commands) {
    for (Canvas& canvas : canvases) canvas.draw(commands, {});
  });
  const auto copy_between = [&](VkCommandBuffer commands, Canvas& from, Canvas& to) {
    transition(commands, from.colour, ImageUse::copy_from);
    transition(commands, to.colour, ImageUse::copy_to);
    const VkImageSubresourceLayers all{.aspectMask = kColour, .layerCount = 1};
    const VkImageCopy copy{.srcSubresource = all, .dstSubresource = all, .extent = {side, side, 1}};
    vkCmdCopyImage(commands, from.colour.get(), layout_of(ImageUse::copy_from), to.colour.get(),
                   layout_of(ImageUse::copy_to), 1, &copy);
  };
  for (int frame = 0; frame < 40; ++frame) {
    VkCommandBuffer commands = ring.begin();
    for (int step = 0; step < 8; ++step) {
      const std::size_t i = random() % 2;
      Canvas& canvas = canvases[i];
      const int fresh = static_cast<int>(random() % 256);
      switch (random() % 5) {
        case 0: {
          transition(commands, canvas.colour, ImageUse::copy_to);
          const VkBufferImageCopy copy{.bufferOffset = static_cast<VkDeviceSize>(fresh) * picture_bytes,
                                       .imageSubresource = {.aspectMask = kColour, .layerCount = 1},
                                       .imageExtent = {side, side, 1}};
          vkCmdCopyBufferToImage(commands, grey.get(), canvas.colour.get(), layout_of(ImageUse::copy_to), 1, &copy);
          value[i] = fresh;
          break;
        }
        case 1:
        case 2: {
          if (random() % 2 == 0) discard_content(canvas.colour);
          const float shade = static_cast<float>(fresh) / 255.0f;
          canvas.draw(commands, {shade, shade, shade, shade});
          value[i] = fresh;
          break;
        }
        case 3:
          copy_between(commands, canvas, canvases[1 - i]);
          value[1 - i] = value[i];
          break;
        default:
          transition(commands, canvas.colour, ImageUse::sampled);
      }
    }
    ring.end();
  }
  ring.wait();
  for (const std::size_t i : {0u, 1u}) {
    const Image image = read_back(gpu, canvases[i].colour);
    CHECK(std::all_of(image.rgba.begin(), image.rgba.end(), [&](int byte) { return byte == value[i]; }));
  }
}
