// Injects rare results of a driver: the test program replaces functions of the Vulkan loader.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <vector>

namespace gearshift::test {

// Results to inject into the next calls; VK_SUCCESS: keep the driver's own result. A present call with an injected
// result is still executed. The other calls are not executed if the injected result is an error.
struct InjectedFaults {
  VkResult next_acquire = VK_SUCCESS;
  VkResult next_present = VK_SUCCESS;
  VkResult next_capabilities = VK_SUCCESS;
  VkResult next_create = VK_SUCCESS;
  bool no_extent = false;                  // while set, the surface reports a size of 0 x 0
  bool never_free = false;                 // while set, acquiring an image always times out
  std::uint64_t waited_ns = 0;             // [ns] total timeout of acquisitions that timed out
  std::vector<VkSemaphore> acquired_with;  // semaphores passed to all acquisitions, in order
};
extern InjectedFaults injected_faults;

}  // namespace gearshift::test
