// A checked glTF file: its JSON, and the bytes to which the JSON refers. gltf.cpp builds the model from it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "engine/model/gltf.h"

namespace gearshift::engine {

struct GltfDocument {
  nlohmann::json json;
  std::vector<std::vector<std::uint8_t>> buffers;   // one per buffer, of the length that the JSON states
  std::filesystem::path folder;                     // folder of the file, for relative paths
  std::vector<std::filesystem::path> files{};       // files that were read from the folder
  std::vector<std::vector<std::uint8_t>> images{};  // encoded images that are not in a buffer, loaded on demand
};

// Both functions throw GltfError, whose message states only the reason, not the file.
GltfDocument open_gltf(const std::filesystem::path& file);

// Returns the encoded bytes of an image, wherever they are stored. The bytes are valid as long as the document exists.
// All images that are not in buffers may have at most kMaxGltfBytes in total.
std::span<const std::uint8_t> image_bytes(GltfDocument& document, std::size_t image);

}  // namespace gearshift::engine
