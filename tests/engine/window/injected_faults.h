// What a driver answers once in a while, on demand: the test program stands before the loader's two functions.
#pragma once

#include <vulkan/vulkan.h>

namespace gearshift {

// The next call's result; VK_SUCCESS: the driver's own. An acquisition that fails is not made; a presentation is.
struct InjectedFaults {
  VkResult next_acquire = VK_SUCCESS;
  VkResult next_present = VK_SUCCESS;
};
extern InjectedFaults injected_faults;

}  // namespace gearshift
