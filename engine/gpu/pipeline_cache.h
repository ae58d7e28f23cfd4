// The driver's compiled pipelines on disk, so that the next start need not compile them again.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "engine/gpu/vulkan.h"

namespace gearshift::engine {

// Returns the data saved for exactly this device and driver; empty if there is none, if it is incomplete or if it
// belongs to another device.
std::vector<std::byte> load_pipeline_cache(const std::filesystem::path& file, const VkPhysicalDeviceProperties& device);

// Written beside the file and renamed, so that the file is never incomplete. Never throws: a cache that cannot be
// written is skipped.
void save_pipeline_cache(const std::filesystem::path& file, std::span<const std::byte> content) noexcept;

}  // namespace gearshift::engine
