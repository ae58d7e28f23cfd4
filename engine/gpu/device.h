// Selects and creates the Vulkan device with its single queue, and records what it supports.
#pragma once

#include <string>

#include "engine/gpu/gpu.h"

namespace gearshift::engine {

class Device {
 public:
  // Prefers a discrete device, then an integrated one, then a software one. `wanted`: substring of the device name; if
  // empty, any device is allowed. `factory`: if not null, selects and creates the device.
  Device(VkInstance instance, bool swapchain, const std::string& wanted, GpuFactory* factory);
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  VkPhysicalDevice physical() const noexcept { return physical_; }
  VkDevice get() const noexcept { return device_; }
  VkQueue queue() const noexcept { return queue_; }
  std::uint32_t family() const noexcept { return family_; }
  const GpuTraits& traits() const noexcept { return traits_; }
  const VkPhysicalDeviceProperties& properties() const noexcept { return properties_; }

 private:
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  std::uint32_t family_ = 0;
  VkPhysicalDeviceProperties properties_{};
  GpuTraits traits_;
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
};

}  // namespace gearshift::engine
