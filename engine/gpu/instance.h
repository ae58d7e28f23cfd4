// The Vulkan instance, with the validation layer if requested and installed.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

#include "engine/gpu/gpu.h"

namespace gearshift::engine {

class Instance {
 public:
  explicit Instance(const GpuConfig& config);
  ~Instance();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  VkInstance get() const noexcept { return instance_; }
  bool validates() const noexcept { return validates_; }
  std::uint64_t messages() const noexcept { return messages_; }

  void count(std::string_view message);  // counts a validation message and passes it to GpuConfig::on_validation

 private:
  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  std::function<void(std::string_view)> on_message_;
  std::uint64_t messages_ = 0;
  bool validates_ = false;
};

}  // namespace gearshift::engine
