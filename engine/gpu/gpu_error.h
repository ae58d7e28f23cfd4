// What a GPU can do wrong.
#pragma once

#include <stdexcept>

#include "engine/gpu/vulkan.h"

namespace gearshift {

// One sentence. No Vulkan device, no memory, a refused pipeline, ...
struct GpuError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The device is gone: the Gpu and all that was made with it must be made anew.
struct GpuLost : GpuError {
  using GpuError::GpuError;
};

// Throws GpuLost for VK_ERROR_DEVICE_LOST, GpuError for any other error: "WHAT failed: VK_ERROR_...".
void check(VkResult result, const char* what);

}  // namespace gearshift
