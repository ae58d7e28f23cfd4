#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/gpu/commands.h"
#include "engine/gpu/gpu_buffer.h"
#include "engine/gpu/gpu_image.h"
#include "tests/support/gpu_fixture.h"

using namespace gearshift::engine;
using namespace gearshift::test;

namespace {

bool any_contains(const std::vector<std::string>& messages, const std::string& part) {
  for (const std::string& message : messages) {
    if (message.find(part) != std::string::npos) return true;
  }
  return false;
}

void fill_twice(Gpu& gpu, bool with_barrier) {
  const GpuBuffer buffer(gpu, 1024, VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryKind::device);
  run_once(gpu, [&](VkCommandBuffer commands) {
    vkCmdFillBuffer(commands, buffer.get(), 0, 1024, 1);
    const VkMemoryBarrier2 barrier{.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
                                   .srcStageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                                   .srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT,
                                   .dstStageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                                   .dstAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT};
    const VkDependencyInfo dependency{
        .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .memoryBarrierCount = 1, .pMemoryBarriers = &barrier};
    if (with_barrier) vkCmdPipelineBarrier2(commands, &dependency);
    vkCmdFillBuffer(commands, buffer.get(), 0, 1024, 2);
  });
}

}  // namespace

TEST_CASE("core validation reports a buffer used against its usage flags, and the message is counted") {
  GpuFixture fixture;
  Gpu& gpu = fixture.gpu();
  const GpuBuffer buffer(gpu, 64, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, MemoryKind::device);
  run_once(gpu, [&](VkCommandBuffer commands) { vkCmdFillBuffer(commands, buffer.get(), 0, 64, 0); });
  CHECK(gpu.validation_messages() >= 1);
  const auto messages = fixture.take_messages();
  CHECK(messages.size() == gpu.validation_messages());
  CHECK(any_contains(messages, "VUID-vkCmdFillBuffer-dstBuffer-00029"));
}

TEST_CASE("core validation reports an image copied from in another layout") {
  GpuFixture fixture;
  Gpu& gpu = fixture.gpu();
  GpuImage image(gpu,
                 {.width = 4, .height = 4, .usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT});
  const GpuBuffer buffer(gpu, 64, VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryKind::read_back);
  run_once(gpu, [&](VkCommandBuffer commands) {
    transition(commands, image, ImageUse::copy_to);
    const VkBufferImageCopy copy{.imageSubresource = {.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .layerCount = 1},
                                 .imageExtent = {4, 4, 1}};
    vkCmdCopyImageToBuffer(commands, image.get(), layout_of(ImageUse::copy_from), buffer.get(), 1, &copy);
  });
  CHECK(any_contains(fixture.take_messages(), "srcImageLayout"));
}

TEST_CASE("synchronization validation reports two writes without a barrier, and nothing else") {
  GpuFixture fixture;
  fill_twice(fixture.gpu(), true);
  CHECK(fixture.silent());
  fill_twice(fixture.gpu(), false);
  CHECK(any_contains(fixture.take_messages(), "SYNC-HAZARD-WRITE-AFTER-WRITE"));
}

TEST_CASE("validation names objects that outlive the device") {
  choose_software_driver();
  std::vector<std::string> messages;
  GpuConfig config;
  config.validation = true;
  config.on_validation = [&](std::string_view message) { messages.emplace_back(message); };
  {
    const Gpu gpu(config);
    const VkBufferCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = 64, .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT};
    VkBuffer leaked = VK_NULL_HANDLE;
    check(vkCreateBuffer(gpu.device(), &info, nullptr, &leaked), "vkCreateBuffer");
  }
  CHECK(any_contains(messages, "VUID-vkDestroyDevice-device-"));  // 00378, in newer layers 05137
}

TEST_CASE("without validation there are no messages") {
  choose_software_driver();
  Gpu gpu(GpuConfig{});
  CHECK_FALSE(gpu.validates());
  fill_twice(gpu, false);
  CHECK(gpu.validation_messages() == 0);
}
