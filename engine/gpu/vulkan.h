// Vulkan's C API, for use with designated initializers.
#pragma once

#include <vulkan/vulkan.h>

// Fields left out of a designated initializer are zero, which is what Vulkan requires of unused fields.
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
