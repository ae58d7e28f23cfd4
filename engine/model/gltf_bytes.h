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

// All functions below throw GltfError, whose message states only the reason, not the file.
std::vector<std::uint8_t> read_file_bytes(const std::filesystem::path& file);

struct GltfChunks {
  std::string_view json;
  std::span<const std::uint8_t> binary;  // empty if there is no binary chunk
};
// Returns the chunks of a .glb or .gltf, which is recognised by its first bytes. The chunks are views into `bytes`.
GltfChunks parse_chunks(std::span<const std::uint8_t> bytes);

// `uri` is a base64 data URI, or the relative path of a file in or below `folder`. Returns its bytes. Adds the file, if
// any, to `files`.
std::vector<std::uint8_t> read_uri(std::string_view uri, const std::filesystem::path& folder,
                                   std::vector<std::filesystem::path>& files);

}  // namespace gearshift::engine
