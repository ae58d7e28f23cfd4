// Buffers of the device, mapped where the host writes or reads them.
#pragma once

#include <cstddef>
#include <span>

#include "engine/gpu/gpu.h"

namespace gearshift {

class GpuBuffer {
 public:
  GpuBuffer() = default;
  GpuBuffer(Gpu& gpu, VkDeviceSize size, VkBufferUsageFlags usage, MemoryKind kind);
  GpuBuffer(GpuBuffer&& other) noexcept;
  GpuBuffer& operator=(GpuBuffer&& other) noexcept;
  ~GpuBuffer();

  VkBuffer get() const noexcept { return buffer_; }
  VkDeviceSize size() const noexcept { return size_; }
  std::byte* mapped() const noexcept { return static_cast<std::byte*>(allocation_.mapped); }  // null: device memory
  explicit operator bool() const noexcept { return buffer_ != VK_NULL_HANDLE; }

 private:
  Gpu* gpu_ = nullptr;
  VkBuffer buffer_ = VK_NULL_HANDLE;
  VkDeviceSize size_ = 0;
  Allocation allocation_;
};

// Device-local and filled, by a staging copy that is waited for: for what is loaded once.
GpuBuffer make_device_buffer(Gpu& gpu, VkBufferUsageFlags usage, std::span<const std::byte> content);

}  // namespace gearshift
