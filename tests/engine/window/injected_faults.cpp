#include "tests/engine/window/injected_faults.h"

#include <dlfcn.h>

#include <cstdint>
#include <utility>

gearshift::InjectedFaults gearshift::injected_faults;

using gearshift::injected_faults;

extern "C" VKAPI_ATTR VkResult VKAPI_CALL vkAcquireNextImageKHR(VkDevice device, VkSwapchainKHR swapchain,
                                                                std::uint64_t timeout, VkSemaphore semaphore,
                                                                VkFence fence, std::uint32_t* index) {
  const VkResult fault = std::exchange(injected_faults.next_acquire, VK_SUCCESS);
  if (fault < VK_SUCCESS || fault == VK_TIMEOUT) return fault;
  const auto real = reinterpret_cast<PFN_vkAcquireNextImageKHR>(dlsym(RTLD_NEXT, "vkAcquireNextImageKHR"));
  const VkResult result = real(device, swapchain, timeout, semaphore, fence, index);
  return fault == VK_SUCCESS || result != VK_SUCCESS ? result : fault;
}

extern "C" VKAPI_ATTR VkResult VKAPI_CALL vkQueuePresentKHR(VkQueue queue, const VkPresentInfoKHR* info) {
  const VkResult fault = std::exchange(injected_faults.next_present, VK_SUCCESS);
  const auto real = reinterpret_cast<PFN_vkQueuePresentKHR>(dlsym(RTLD_NEXT, "vkQueuePresentKHR"));
  const VkResult result = real(queue, info);
  return fault == VK_SUCCESS ? result : fault;
}
