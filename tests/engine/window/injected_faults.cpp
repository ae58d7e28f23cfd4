#include "tests/engine/window/injected_faults.h"

#include <dlfcn.h>

#include <cstdint>
#include <utility>

gearshift::test::InjectedFaults gearshift::test::injected_faults;

using gearshift::test::injected_faults;

extern "C" VKAPI_ATTR VkResult VKAPI_CALL vkAcquireNextImageKHR(VkDevice device, VkSwapchainKHR swapchain,
                                                                std::uint64_t timeout, VkSemaphore semaphore,
                                                                VkFence fence, std::uint32_t* index) {
  injected_faults.acquired_with.push_back(semaphore);
  if (injected_faults.never_free) {
    injected_faults.waited_ns += timeout;
    return timeout == 0 ? VK_NOT_READY : VK_TIMEOUT;
  }
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

extern "C" VKAPI_ATTR VkResult VKAPI_CALL vkGetPhysicalDeviceSurfaceCapabilitiesKHR(
    VkPhysicalDevice device, VkSurfaceKHR surface, VkSurfaceCapabilitiesKHR* capabilities) {
  const VkResult fault = std::exchange(injected_faults.next_capabilities, VK_SUCCESS);
  if (fault != VK_SUCCESS) return fault;
  const auto real = reinterpret_cast<PFN_vkGetPhysicalDeviceSurfaceCapabilitiesKHR>(
      dlsym(RTLD_NEXT, "vkGetPhysicalDeviceSurfaceCapabilitiesKHR"));
  const VkResult result = real(device, surface, capabilities);
  if (injected_faults.no_extent) capabilities->currentExtent = {0, 0};
  return result;
}

extern "C" VKAPI_ATTR VkResult VKAPI_CALL vkCreateSwapchainKHR(VkDevice device, const VkSwapchainCreateInfoKHR* info,
                                                               const VkAllocationCallbacks* allocator,
                                                               VkSwapchainKHR* swapchain) {
  const VkResult fault = std::exchange(injected_faults.next_create, VK_SUCCESS);
  if (fault != VK_SUCCESS) return fault;
  const auto real = reinterpret_cast<PFN_vkCreateSwapchainKHR>(dlsym(RTLD_NEXT, "vkCreateSwapchainKHR"));
  return real(device, info, allocator, swapchain);
}
