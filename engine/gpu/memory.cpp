#include "engine/gpu/memory.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <iterator>

#include <fmt/format.h>

namespace gearshift::engine {
namespace {

constexpr VkDeviceSize kBlockSize = VkDeviceSize{32} << 20;
constexpr VkMemoryPropertyFlags kMapped = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;

// Memory properties in order of preference: best first, then acceptable.
std::array<VkMemoryPropertyFlags, 2> memory_preferences(MemoryKind kind) {
  switch (kind) {
    case MemoryKind::device:
      return {VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0};
    case MemoryKind::upload:
      return {kMapped, kMapped};
    case MemoryKind::read_back:
      break;
  }
  return {kMapped | VK_MEMORY_PROPERTY_HOST_CACHED_BIT, kMapped};
}

}  // namespace

std::optional<VkDeviceSize> FreeRanges::allocate(VkDeviceSize size, VkDeviceSize alignment) {
  for (const auto& [start, length] : free_) {
    const VkDeviceSize offset = (start + alignment - 1) & ~(alignment - 1);
    const VkDeviceSize end = start + length;
    if (offset + size > end) continue;
    const VkDeviceSize padding = offset - start;
    free_.erase(start);
    if (padding > 0) free_.emplace(offset - padding, padding);
    if (offset + size < end) free_.emplace(offset + size, end - offset - size);
    return offset;
  }
  return std::nullopt;
}

void FreeRanges::release(VkDeviceSize offset, VkDeviceSize size) {
  const auto next = free_.lower_bound(offset);
  assert(next == free_.end() || offset + size <= next->first);
  if (next != free_.end() && next->first == offset + size) {
    size += next->second;
    free_.erase(next);
  }
  const auto inserted = free_.emplace(offset, size).first;
  if (inserted == free_.begin()) return;
  const auto previous = std::prev(inserted);
  assert(previous->first + previous->second <= offset);
  if (previous->first + previous->second != offset) return;
  previous->second += size;
  free_.erase(inserted);
}

DeviceMemory::DeviceMemory(VkPhysicalDevice physical, VkDevice device) : device_(device) {
  vkGetPhysicalDeviceMemoryProperties(physical, &properties_);
}

DeviceMemory::~DeviceMemory() {
  for (const auto& block : blocks_) vkFreeMemory(device_, block->memory, nullptr);
}

std::uint32_t DeviceMemory::type_for(std::uint32_t allowed, MemoryKind kind) const {
  for (const VkMemoryPropertyFlags preferred : memory_preferences(kind)) {
    for (std::uint32_t i = 0; i < properties_.memoryTypeCount; ++i) {
      const bool fits = (properties_.memoryTypes[i].propertyFlags & preferred) == preferred;
      if (fits && (allowed >> i & 1u) != 0) return i;
    }
  }
  throw GpuError("The graphics device has no suitable memory type.");
}

MemoryBlock& DeviceMemory::add_block(VkDeviceSize size, std::uint32_t type, MemoryUser user) {
  const VkDeviceSize heap = properties_.memoryHeaps[properties_.memoryTypes[type].heapIndex].size;
  if (size > heap)
    throw GpuError(fmt::format("The graphics device does not have the {} MiB of memory that are needed.", size >> 20));
  const VkMemoryAllocateInfo info{
      .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, .allocationSize = size, .memoryTypeIndex = type};
  blocks_.reserve(blocks_.size() + 1);
  auto block = std::make_unique<MemoryBlock>(MemoryBlock{VK_NULL_HANDLE, nullptr, type, user, FreeRanges(size)});
  check(vkAllocateMemory(device_, &info, nullptr, &block->memory), "vkAllocateMemory");
  if ((properties_.memoryTypes[type].propertyFlags & kMapped) == kMapped) {
    void* mapped = nullptr;
    const VkResult result = vkMapMemory(device_, block->memory, 0, VK_WHOLE_SIZE, 0, &mapped);
    if (result != VK_SUCCESS) vkFreeMemory(device_, block->memory, nullptr);
    check(result, "vkMapMemory");
    block->mapped = static_cast<std::byte*>(mapped);
  }
  blocks_.push_back(std::move(block));
  return *blocks_.back();
}

Allocation DeviceMemory::allocate(const VkMemoryRequirements& needs, MemoryKind kind, MemoryUser user) {
  const std::uint32_t type = type_for(needs.memoryTypeBits, kind);
  MemoryBlock* block_used = nullptr;
  std::optional<VkDeviceSize> offset;
  for (const auto& block : blocks_) {
    if (block->type != type || block->user != user) continue;
    block_used = block.get();
    if ((offset = block_used->ranges.allocate(needs.size, needs.alignment))) break;
  }
  if (!offset) {
    block_used = &add_block(std::max(needs.size, kBlockSize), type, user);
    offset = block_used->ranges.allocate(needs.size, needs.alignment);
  }
  in_use_ += needs.size;
  return {.memory = block_used->memory,
          .offset = *offset,
          .size = needs.size,
          .mapped = block_used->mapped == nullptr ? nullptr : block_used->mapped + *offset,
          .block = block_used};
}

void DeviceMemory::free(const Allocation& allocation) noexcept {
  if (allocation.block == nullptr) return;
  in_use_ -= allocation.size;
  allocation.block->ranges.release(allocation.offset, allocation.size);
  if (!allocation.block->ranges.is_unused()) return;
  const auto block =
      std::find_if(blocks_.begin(), blocks_.end(), [&](const auto& b) { return b.get() == allocation.block; });
  vkFreeMemory(device_, (*block)->memory, nullptr);
  blocks_.erase(block);
}

}  // namespace gearshift::engine
