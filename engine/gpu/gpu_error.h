// Errors of the GPU.
#pragma once

#include <stdexcept>

#include "engine/gpu/vulkan.h"

namespace gearshift::engine {

// The message is one sentence: no Vulkan device, out of memory, pipeline rejected, ...
struct GpuError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The device is lost: the Gpu and everything created from it must be recreated.
struct GpuLost : GpuError {
  using GpuError::GpuError;
};

// Throws GpuLost for VK_ERROR_DEVICE_LOST and GpuError for any other error. The message is "WHAT failed: VK_ERROR_...".
void check(VkResult result, const char* what);

}  // namespace gearshift::engine
