// The driver's compiled pipelines on disk: what the next start need not compile again.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "engine/gpu/vulkan.h"

namespace gearshift {

// What was saved for this very device and driver; empty when there is none, it is torn or it is another's.
std::vector<std::byte> load_pipeline_cache(const std::filesystem::path& file, const VkPhysicalDeviceProperties& device);

// Whole or not at all: written beside the file and renamed. A cache that cannot be written is none: never throws.
void save_pipeline_cache(const std::filesystem::path& file, std::span<const std::byte> content) noexcept;

}  // namespace gearshift
