#include "engine/model/gltf_document.h"

#include <fmt/core.h>

#include "engine/model/gltf_bytes.h"
#include "engine/model/gltf_check.h"

namespace gearshift::engine {

using nlohmann::json;

namespace {

constexpr int kMaxJsonDepth = 64;  // [levels] glTF itself needs about ten, extensions a few more

// Checks, before a parser builds anything, how deeply the text is nested and how many values it has. A base64 string
// counts as one value. Text that is not JSON may be counted wrongly; the parser then rejects it.
void check_extent(std::string_view text) {
  int depth = 0;
  std::uint64_t values = 1;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      in_string = c != '"';
      continue;
    }
    in_string = c == '"';
    if (c == '{' || c == '[') ++depth;
    if (c == '}' || c == ']') --depth;
    if (c == '{' || c == '[' || c == ',' || c == ':') ++values;
    if (depth > kMaxJsonDepth) throw GltfError("the JSON is nested too deeply");
    if (values > kMaxGltfValues) throw GltfError("the JSON has too many values");
  }
}

json parsed(std::string_view text) {
  check_extent(text);
  try {
    return json::parse(text.begin(), text.end());
  } catch (const json::parse_error& e) {
    throw GltfError(fmt::format("the file is neither .glb nor valid JSON (error at byte {})", e.byte));
  } catch (const json::exception&) {
    throw GltfError("the JSON has a number that is out of range");
  }
}

std::vector<std::uint8_t> buffer_bytes(GltfDocument& document, std::size_t index,
                                       std::span<const std::uint8_t> binary) {
  const json& buffer = document.json.at("buffers").at(index);
  const std::size_t size = buffer.at("byteLength").get<std::size_t>();
  if (!buffer.contains("uri")) return {binary.begin(), binary.begin() + static_cast<std::ptrdiff_t>(size)};
  std::vector<std::uint8_t> bytes =
      read_uri(buffer.at("uri").get_ref<const std::string&>(), document.folder, document.files);
  if (bytes.size() < size) {
    throw GltfError(fmt::format("buffers[{}] has {} bytes instead of {}", index, bytes.size(), size));
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace

GltfDocument open_gltf(const std::filesystem::path& file) {
  const std::vector<std::uint8_t> bytes = read_file_bytes(file);
  const GltfChunks chunks = parse_chunks(bytes);
  GltfDocument document{parsed(chunks.json), {}, file.parent_path()};
  check_gltf(document.json, chunks.binary.size());
  if (!document.json.contains("buffers")) return document;
  for (std::size_t i = 0; i < document.json["buffers"].size(); ++i) {
    document.buffers.push_back(buffer_bytes(document, i, chunks.binary));
  }
  return document;
}

std::span<const std::uint8_t> image_bytes(GltfDocument& document, std::size_t image) {
  const json& description = document.json.at("images").at(image);
  if (description.contains("uri")) {
    const std::string& uri = description.at("uri").get_ref<const std::string&>();
    document.images.push_back(read_uri(uri, document.folder, document.files));
    std::uint64_t bytes = 0;
    for (const auto& read : document.images) bytes += read.size();
    if (bytes > kMaxGltfBytes) throw GltfError("the images have too many bytes in total");
    return document.images.back();
  }
  const json& view = document.json.at("bufferViews").at(description.at("bufferView").get<std::size_t>());
  const std::vector<std::uint8_t>& buffer = document.buffers.at(view.at("buffer").get<std::size_t>());
  return std::span(buffer).subspan(view.value("byteOffset", std::size_t{0}), view.at("byteLength").get<std::size_t>());
}

}  // namespace gearshift::engine
