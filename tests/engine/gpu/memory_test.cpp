#include "engine/gpu/memory.h"

#include <cstring>
#include <list>
#include <random>
#include <set>

#include <doctest/doctest.h>

#include "engine/gpu/gpu_buffer.h"
#include "engine/gpu/gpu_image.h"
#include "tests/support/gpu_fixture.h"

using namespace gearshift::engine;
using namespace gearshift::test;

TEST_CASE("ranges of a block never overlap, are aligned and first-fit, and can all be released") {
  constexpr VkDeviceSize size = 4096;
  std::mt19937 random(3);
  FreeRanges ranges(size);
  std::array<bool, size> used{};  // reference for the comparison: one flag per byte
  std::vector<std::pair<VkDeviceSize, VkDeviceSize>> allocated;
  const auto first_fit = [&](VkDeviceSize wanted, VkDeviceSize alignment) -> std::optional<VkDeviceSize> {
    for (VkDeviceSize start = 0; start + wanted <= size; start += alignment) {
      const auto begin = used.begin() + static_cast<std::ptrdiff_t>(start);
      if (std::find(begin, begin + static_cast<std::ptrdiff_t>(wanted), true) ==
          begin + static_cast<std::ptrdiff_t>(wanted)) {
        return start;
      }
    }
    return std::nullopt;
  };
  int refused = 0;
  for (int step = 0; step < 5000; ++step) {
    if (random() % 5 < 3 || allocated.empty()) {
      const VkDeviceSize wanted = 1 + random() % 200, alignment = VkDeviceSize{1} << random() % 8;
      const auto expected = first_fit(wanted, alignment);
      const auto offset = ranges.allocate(wanted, alignment);
      REQUIRE(offset == expected);
      refused += !offset;
      if (!offset) continue;
      std::fill_n(used.begin() + static_cast<std::ptrdiff_t>(*offset), wanted, true);
      allocated.emplace_back(*offset, wanted);
    } else {
      std::swap(allocated[random() % allocated.size()], allocated.back());
      const auto [offset, length] = allocated.back();
      allocated.pop_back();
      ranges.release(offset, length);
      std::fill_n(used.begin() + static_cast<std::ptrdiff_t>(offset), length, false);
    }
    REQUIRE(ranges.is_unused() == allocated.empty());
  }
  CHECK(refused > 0);
  for (const auto& [offset, length] : allocated) ranges.release(offset, length);
  CHECK(ranges.is_unused());
  CHECK(ranges.allocate(size, 1) == VkDeviceSize{0});
}

TEST_CASE("buffers created and destroyed in any order keep their bytes, and their memory is freed") {
  GpuFixture fixture;
  Gpu& gpu = fixture.gpu();
  std::mt19937 random(5);
  struct Owned {
    GpuBuffer buffer;
    int byte;
  };
  std::vector<Owned> owned;
  const auto is_intact = [](const Owned& o) {
    const auto* bytes = o.buffer.mapped();
    const auto is_own = [&](std::byte b) { return b == static_cast<std::byte>(o.byte); };
    return std::all_of(bytes, bytes + o.buffer.size(), is_own);
  };
  for (int step = 0; step < 400; ++step) {
    if (random() % 2 == 0 || owned.empty()) {
      const VkDeviceSize size = 1 + random() % (VkDeviceSize{1} << (4 + random() % 16));
      const MemoryKind kind = random() % 2 == 0 ? MemoryKind::upload : MemoryKind::read_back;
      Owned owned_buffer{GpuBuffer(gpu, size, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, kind), step % 256};
      std::memset(owned_buffer.buffer.mapped(), owned_buffer.byte, owned_buffer.buffer.size());
      owned.push_back(std::move(owned_buffer));
    } else {
      std::swap(owned[random() % owned.size()], owned.back());
      CHECK(is_intact(owned.back()));
      owned.pop_back();
    }
  }
  CHECK(gpu.allocated() > 0);
  for (const Owned& o : owned) CHECK(is_intact(o));
  owned.clear();
  CHECK(gpu.allocated() == 0);
}

TEST_CASE("small allocations share a block, large ones get their own; buffers and images never share one") {
  GpuFixture fixture;
  Gpu& gpu = fixture.gpu();
  const auto needs = [](VkDeviceSize size) {
    return VkMemoryRequirements{.size = size, .alignment = 256, .memoryTypeBits = ~0u};
  };
  const Allocation a = gpu.allocate(needs(1000), MemoryKind::device, MemoryUser::buffer);
  const Allocation b = gpu.allocate(needs(1000), MemoryKind::device, MemoryUser::buffer);
  const Allocation image = gpu.allocate(needs(1000), MemoryKind::device, MemoryUser::image);
  const Allocation large = gpu.allocate(needs(VkDeviceSize{40} << 20), MemoryKind::device, MemoryUser::buffer);
  CHECK(a.memory == b.memory);
  CHECK(b.offset == a.offset + 1024);
  CHECK(image.memory != a.memory);
  CHECK(large.memory != a.memory);
  CHECK(large.offset == 0);
  CHECK(gpu.allocated() == 3000 + (VkDeviceSize{40} << 20));
  for (const Allocation& allocation : {a, b, image, large}) gpu.free(allocation);
  CHECK(gpu.allocated() == 0);
}

TEST_CASE("an allocation that is too large throws GpuError, and others still work") {
  GpuFixture fixture;
  Gpu& gpu = fixture.gpu();
  const VkMemoryRequirements absurd{.size = VkDeviceSize{1} << 50, .alignment = 1, .memoryTypeBits = ~0u};
  CHECK_THROWS_AS(gpu.allocate(absurd, MemoryKind::device, MemoryUser::buffer), GpuError);
  CHECK(gpu.allocated() == 0);
  CHECK_NOTHROW(GpuBuffer(gpu, 64, VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryKind::device));
}
