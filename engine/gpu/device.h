// Which device, what it can do, and its one queue.
#pragma once

#include <string>

#include "engine/gpu/gpu.h"

namespace gearshift {

class Device {
 public:
  // A discrete device before an integrated before a software one; wanted: part of a name, empty for any. maker: chooses
  // and makes it, where not null.
  Device(VkInstance instance, bool swapchain, const std::string& wanted, GpuMaker* maker);
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

}  // namespace gearshift
