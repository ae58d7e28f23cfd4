// Vulkan buffers, mapped if the host reads or writes the content.
#pragma once

#include <cstddef>
#include <span>

#include "engine/gpu/gpu.h"

namespace gearshift::engine {

class GpuBuffer {
 public:
  GpuBuffer() = default;
  GpuBuffer(Gpu& gpu, VkDeviceSize size, VkBufferUsageFlags usage, MemoryKind kind);
  GpuBuffer(GpuBuffer&& other) noexcept;
  GpuBuffer& operator=(GpuBuffer&& other) noexcept;
  ~GpuBuffer();

  VkBuffer get() const noexcept { return buffer_; }
  VkDeviceSize size() const noexcept { return size_; }
  // Null if the memory is not host-visible.
  std::byte* mapped() const noexcept { return static_cast<std::byte*>(allocation_.mapped); }
  explicit operator bool() const noexcept { return buffer_ != VK_NULL_HANDLE; }

 private:
  Gpu* gpu_ = nullptr;
  VkBuffer buffer_ = VK_NULL_HANDLE;
  VkDeviceSize size_ = 0;
  Allocation allocation_;
};

// Creates a device-local buffer and fills it through a staging copy. Waits for the copy, so use it at load time only.
GpuBuffer make_device_buffer(Gpu& gpu, VkBufferUsageFlags usage, std::span<const std::byte> content);

}  // namespace gearshift::engine
