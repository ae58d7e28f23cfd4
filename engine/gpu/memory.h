// Device memory, allocated first-fit from blocks.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "engine/gpu/gpu.h"

namespace gearshift::engine {

// The free ranges within [0, size). Adjacent ranges are merged.
class FreeRanges {
 public:
  explicit FreeRanges(VkDeviceSize size) : size_(size), free_{{0, size}} {}
  // Allocates from the first free range that fits, and returns its offset. Returns empty if none fits. `alignment`: a
  // power of two.
  std::optional<VkDeviceSize> allocate(VkDeviceSize size, VkDeviceSize alignment);
  void release(VkDeviceSize offset, VkDeviceSize size);  // frees a range returned by allocate()
  bool is_unused() const { return free_.size() == 1 && free_.begin()->second == size_; }

 private:
  VkDeviceSize size_;
  std::map<VkDeviceSize, VkDeviceSize> free_;  // offset -> size
};

struct MemoryBlock {
  VkDeviceMemory memory;
  std::byte* mapped;  // null: not host-visible
  std::uint32_t type;
  MemoryUser user;
  FreeRanges ranges;
};

class DeviceMemory {
 public:
  DeviceMemory(VkPhysicalDevice physical, VkDevice device);
  ~DeviceMemory();
  DeviceMemory(const DeviceMemory&) = delete;
  DeviceMemory& operator=(const DeviceMemory&) = delete;

  Allocation allocate(const VkMemoryRequirements& needs, MemoryKind kind, MemoryUser user);
  void free(const Allocation& allocation) noexcept;
  VkDeviceSize in_use() const noexcept { return in_use_; }

 private:
  std::uint32_t type_for(std::uint32_t allowed, MemoryKind kind) const;
  MemoryBlock& add_block(VkDeviceSize size, std::uint32_t type, MemoryUser user);
  VkDevice device_;
  VkPhysicalDeviceMemoryProperties properties_{};
  std::vector<std::unique_ptr<MemoryBlock>> blocks_;
  VkDeviceSize in_use_ = 0;
};

}  // namespace gearshift::engine
