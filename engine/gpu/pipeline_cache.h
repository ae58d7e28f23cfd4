// The driver's compiled pipelines on disk, so that the next start need not compile them again.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "engine/gpu/vulkan.h"

namespace gearshift::engine {

// Returns the data saved for exactly this device and driver; empty if the file is missing, incomplete, or from a
// different device or driver.
std::vector<std::byte> load_pipeline_cache(const std::filesystem::path& file, const VkPhysicalDeviceProperties& device);

// Writes a temporary file next to `file` and renames it, so that `file` is never incomplete. Never throws: a cache that
// cannot be written is skipped.
void save_pipeline_cache(const std::filesystem::path& file, std::span<const std::byte> content) noexcept;

}  // namespace gearshift::engine
