// A glTF file taken apart: its JSON and the bytes it refers to, all checked. What is made of them: gltf.cpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "engine/model/gltf.h"

namespace gearshift {

struct GltfDocument {
  nlohmann::json json;
  std::vector<std::vector<std::uint8_t>> buffers;   // as long as the JSON says, one a buffer
  std::filesystem::path folder;                     // where files beside it lie
  std::vector<std::filesystem::path> files{};       // those of them that were read
  std::vector<std::vector<std::uint8_t>> images{};  // encoded, of those that lie in no buffer and were asked for
};

// All of these throw GltfError with the reason alone.
GltfDocument open_gltf(const std::filesystem::path& file);

// The encoded bytes of an image of the document, from wherever they lie; as long as the document. At most
// kMostGltfBytes of those that lie in no buffer.
std::span<const std::uint8_t> image_bytes(GltfDocument& document, std::size_t image);

}  // namespace gearshift
