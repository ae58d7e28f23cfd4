// Where the bytes of a glTF file lie: the file, the chunks of a .glb, data URIs, files beside it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gearshift {

// A name out of a file, fit for a sentence: short, and without what a terminal would obey.
std::string shown_name(std::string_view text);

// All throw GltfError with the reason alone.
std::vector<std::uint8_t> whole_file(const std::filesystem::path& file);

struct GltfChunks {
  std::string_view json;
  std::span<const std::uint8_t> binary;  // empty where there is none
};
// Of a .glb or a .gltf, told apart by their first bytes; views into `bytes`.
GltfChunks chunks_of(std::span<const std::uint8_t> bytes);

// A base64 data URI, or a relative path to a file in `folder` or below it, which is added to `files`.
std::vector<std::uint8_t> bytes_at(std::string_view uri, const std::filesystem::path& folder,
                                   std::vector<std::filesystem::path>& files);

}  // namespace gearshift
