// Vulkan's C API, written with designated initializers.
#pragma once

#include <vulkan/vulkan.h>

// What a designated initializer leaves out is zero, as Vulkan wants its unused fields: no oversight to warn of.
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
