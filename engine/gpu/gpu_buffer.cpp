#include "engine/gpu/gpu_buffer.h"

#include <cstring>
#include <utility>

#include "engine/gpu/commands.h"

namespace gearshift::engine {

GpuBuffer::GpuBuffer(Gpu& gpu, VkDeviceSize size, VkBufferUsageFlags usage, MemoryKind kind) : gpu_(&gpu), size_(size) {
  const VkBufferCreateInfo info{.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = size, .usage = usage};
  check(vkCreateBuffer(gpu.device(), &info, nullptr, &buffer_), "vkCreateBuffer");
  VkMemoryRequirements needs;
  vkGetBufferMemoryRequirements(gpu.device(), buffer_, &needs);
  try {
    allocation_ = gpu.allocate(needs, kind, MemoryUser::buffer);
    check(vkBindBufferMemory(gpu.device(), buffer_, allocation_.memory, allocation_.offset), "vkBindBufferMemory");
  } catch (...) {
    vkDestroyBuffer(gpu.device(), buffer_, nullptr);
    gpu.free(allocation_);
    throw;
  }
}

GpuBuffer::GpuBuffer(GpuBuffer&& other) noexcept {
  *this = std::move(other);
}

GpuBuffer& GpuBuffer::operator=(GpuBuffer&& other) noexcept {
  std::swap(gpu_, other.gpu_);
  std::swap(buffer_, other.buffer_);
  std::swap(size_, other.size_);
  std::swap(allocation_, other.allocation_);
  return *this;
}

GpuBuffer::~GpuBuffer() {
  if (buffer_ == VK_NULL_HANDLE) return;
  vkDestroyBuffer(gpu_->device(), buffer_, nullptr);
  gpu_->free(allocation_);  // NOLINT(clang-analyzer-unix.Malloc): this is Gpu::free, not the C function
}

GpuBuffer make_device_buffer(Gpu& gpu, VkBufferUsageFlags usage, std::span<const std::byte> content) {
  GpuBuffer staging(gpu, content.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT, MemoryKind::upload);
  std::memcpy(staging.mapped(), content.data(), content.size());
  GpuBuffer buffer(gpu, content.size(), usage | VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryKind::device);
  run_once(gpu, [&](VkCommandBuffer commands) {
    const VkBufferCopy copy{.size = content.size()};
    vkCmdCopyBuffer(commands, staging.get(), buffer.get(), 1, &copy);
    const VkMemoryBarrier2 visible{.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
                                   .srcStageMask = VK_PIPELINE_STAGE_2_COPY_BIT,
                                   .srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT,
                                   .dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                                   .dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT};
    const VkDependencyInfo dependency{
        .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .memoryBarrierCount = 1, .pMemoryBarriers = &visible};
    vkCmdPipelineBarrier2(commands, &dependency);
  });
  return buffer;
}

}  // namespace gearshift::engine
