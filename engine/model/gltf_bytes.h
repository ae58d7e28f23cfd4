// Reads the bytes of a glTF file from where they are stored: the file itself, chunks of a .glb, data URIs, files beside
// it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gearshift::engine {

// Prepares a name from a file for an error message: shortens it and removes control characters.
std::string printable_name(std::string_view text);

// All of these throw GltfError with only the reason.
std::vector<std::uint8_t> read_whole_file(const std::filesystem::path& file);

struct GltfChunks {
  std::string_view json;
  std::span<const std::uint8_t> binary;  // empty if there is none
};
// Splits a .glb or .gltf, recognised by its first bytes, into views into `bytes`.
GltfChunks parse_chunks(std::span<const std::uint8_t> bytes);

// Reads a base64 data URI, or a relative path to a file in or below `folder`; the file is added to `files`.
std::vector<std::uint8_t> read_uri(std::string_view uri, const std::filesystem::path& folder,
                                   std::vector<std::filesystem::path>& files);

}  // namespace gearshift::engine
