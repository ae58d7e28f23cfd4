// Injects rare results of a driver: the test program overrides the loader's functions.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <vector>

namespace gearshift::test {

// Result of the next call; VK_SUCCESS: the driver's own. A failing present is still executed, the other calls are not.
struct InjectedFaults {
  VkResult next_acquire = VK_SUCCESS;
  VkResult next_present = VK_SUCCESS;
  VkResult next_capabilities = VK_SUCCESS;
  VkResult next_create = VK_SUCCESS;
  bool no_extent = false;                  // while set, the surface reports a size of 0 x 0
  bool never_free = false;                 // while set, acquiring an image always times out
  std::uint64_t waited_ns = 0;             // total wait for images that did not come
  std::vector<VkSemaphore> acquired_with;  // semaphores of all acquisitions, in order
};
extern InjectedFaults injected_faults;

}  // namespace gearshift::test
