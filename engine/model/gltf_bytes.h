// Reads the bytes of a glTF file from where they are stored: the file itself, chunks of a .glb, data URIs, files in
// or below its folder.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gearshift::engine {

// Prepares a name found in a file for an error message: shortens it and removes control characters.
std::string printable_name(std::string_view text);

// All functions below throw GltfError with only the reason.
std::vector<std::uint8_t> read_file_bytes(const std::filesystem::path& file);

struct GltfChunks {
  std::string_view json;
  std::span<const std::uint8_t> binary;  // empty if there is none
};
// Splits a .glb or .gltf, recognised by its first bytes, into its chunks: views into `bytes`.
GltfChunks parse_chunks(std::span<const std::uint8_t> bytes);

// Returns the bytes of a base64 data URI, or of a file in or below `folder` given by its relative path; adds that file
// to `files`.
std::vector<std::uint8_t> read_uri(std::string_view uri, const std::filesystem::path& folder,
                                   std::vector<std::filesystem::path>& files);

}  // namespace gearshift::engine
