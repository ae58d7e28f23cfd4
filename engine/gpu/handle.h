// A Vulkan object that is destroyed with its owner.
#pragma once

#include <utility>

#include "engine/gpu/vulkan.h"

namespace gearshift::engine {

// `Destroy`: a function such as vkDestroySampler, with the signature (VkDevice, handle, allocator).
template <class T, auto Destroy>
class Handle {
 public:
  Handle() = default;
  Handle(VkDevice device, T value) noexcept : device_(device), value_(value) {}
  Handle(Handle&& other) noexcept : device_(other.device_), value_(std::exchange(other.value_, VK_NULL_HANDLE)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(value_, other.value_);
    return *this;
  }
  ~Handle() {
    if (value_ != VK_NULL_HANDLE) Destroy(device_, value_, nullptr);
  }

  T get() const noexcept { return value_; }
  const T* address() const noexcept { return &value_; }
  explicit operator bool() const noexcept { return value_ != VK_NULL_HANDLE; }

 private:
  VkDevice device_ = VK_NULL_HANDLE;
  T value_ = VK_NULL_HANDLE;
};

using ImageView = Handle<VkImageView, vkDestroyImageView>;
using Sampler = Handle<VkSampler, vkDestroySampler>;
using ShaderModule = Handle<VkShaderModule, vkDestroyShaderModule>;
using PipelineLayout = Handle<VkPipelineLayout, vkDestroyPipelineLayout>;
using Pipeline = Handle<VkPipeline, vkDestroyPipeline>;
using SetLayout = Handle<VkDescriptorSetLayout, vkDestroyDescriptorSetLayout>;
using DescriptorPool = Handle<VkDescriptorPool, vkDestroyDescriptorPool>;
using CommandPool = Handle<VkCommandPool, vkDestroyCommandPool>;
using QueryPool = Handle<VkQueryPool, vkDestroyQueryPool>;
using Semaphore = Handle<VkSemaphore, vkDestroySemaphore>;

}  // namespace gearshift::engine
