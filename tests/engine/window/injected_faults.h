// What a driver answers once in a while, on demand: the test program stands before the loader's functions.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <vector>

namespace gearshift {

// The next call's result; VK_SUCCESS: the driver's own. A presentation that fails is made nevertheless, the others are
// not.
struct InjectedFaults {
  VkResult next_acquire = VK_SUCCESS;
  VkResult next_present = VK_SUCCESS;
  VkResult next_capabilities = VK_SUCCESS;
  VkResult next_create = VK_SUCCESS;
  bool no_extent = false;                  // the surface says 0 x 0 while this is set
  bool never_free = false;                 // no image comes, for as long as one waits, while this is set
  std::uint64_t waited_ns = 0;             // for images that did not come
  std::vector<VkSemaphore> acquired_with;  // of all acquisitions, in order
};
extern InjectedFaults injected_faults;

}  // namespace gearshift
