#include "engine/model/gltf_bytes.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <string>
#include <system_error>

#include <fmt/core.h>

#include "engine/model/gltf.h"

namespace gearshift::engine {

namespace {

// Magic number and chunk types of a .glb file (glTF 2.0, section 4.4). They are little-endian, like every supported
// machine.
constexpr std::uint32_t kMagic = 0x46546C67, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
constexpr std::size_t kHeaderBytes = 12, kChunkHeaderBytes = 8;

std::uint32_t word(std::span<const std::uint8_t> bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

struct Chunk {
  std::uint32_t type = 0;
  std::span<const std::uint8_t> bytes;
};

Chunk read_chunk(std::span<const std::uint8_t>& rest) {
  if (rest.size() < kChunkHeaderBytes) throw GltfError("a chunk is cut off");
  const std::uint32_t length = word(rest, 0);
  const Chunk chunk{word(rest, 4), rest.subspan(kChunkHeaderBytes)};
  if (length > chunk.bytes.size()) throw GltfError("a chunk is cut off");
  rest = chunk.bytes.subspan(length);
  return {chunk.type, chunk.bytes.first(length)};
}

std::string_view as_text(std::span<const std::uint8_t> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

int base64_value(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+') return 62;
  return c == '/' ? 63 : -1;
}

// Decodes base64 (RFC 4648), with or without padding.
std::vector<std::uint8_t> decoded_base64(std::string_view text) {
  for (int i = 0; i < 2 && !text.empty() && text.back() == '='; ++i) text.remove_suffix(1);
  std::vector<std::uint8_t> bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const int value = base64_value(c);
    if (value < 0) throw GltfError("a data URI is not base64");
    bits = bits << 6 | static_cast<std::uint32_t>(value);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<std::uint8_t>(bits >> count));
  }
  return bytes;
}

int hex_value(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

std::string percent_decoded(std::string_view uri) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] != '%') {
      text += uri[i];
      continue;
    }
    const int high = i + 2 < uri.size() ? hex_value(uri[i + 1]) : -1;
    const int low = i + 2 < uri.size() ? hex_value(uri[i + 2]) : -1;
    if (high < 0 || low < 0) throw GltfError("a URI has an invalid percent escape");
    text += static_cast<char>(high << 4 | low);
    i += 2;
  }
  return text;
}

bool is_inside(const std::filesystem::path& file, const std::filesystem::path& folder) {
  const auto [end, _] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
  return end == folder.end();
}

std::filesystem::path referenced_file(const std::string& name, const std::filesystem::path& folder) {
  const std::filesystem::path relative(name);
  const bool plain = !name.empty() && name.find('\0') == std::string::npos && name.find(':') == std::string::npos;
  if (!plain || relative.is_absolute()) throw GltfError("a URI is neither base64 data nor a relative path");
  std::error_code error;
  const std::filesystem::path root = std::filesystem::canonical(folder.empty() ? "." : folder, error);
  // Resolve symbolic links before checking that the file is inside the folder.
  std::filesystem::path file = error ? root : std::filesystem::weakly_canonical(root / relative, error);
  if (error || !is_inside(file, root)) throw GltfError("a URI points outside the file's folder");
  return file;
}

}  // namespace

std::string printable_name(std::string_view text) {
  std::string printable(text.substr(0, 80));
  for (char& c : printable) {
    if (c < 0x20 || c > 0x7e) c = '?';
  }
  return printable;
}

std::vector<std::uint8_t> read_file_bytes(const std::filesystem::path& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) throw GltfError("there is no such file");
  if (std::filesystem::is_directory(status)) throw GltfError("this is a folder, not a file");
  if (!std::filesystem::is_regular_file(status)) throw GltfError("this is not a regular file");
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error) throw GltfError(error.message());
  if (size > kMaxGltfBytes) throw GltfError("the file is too large");
  std::ifstream in(file, std::ios::binary);
  std::vector<std::uint8_t> bytes(size);
  if (!in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size))) {
    throw GltfError("the file cannot be read");
  }
  return bytes;
}

GltfChunks parse_chunks(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < 4 || word(bytes, 0) != kMagic) return {as_text(bytes), {}};
  if (bytes.size() < kHeaderBytes + kChunkHeaderBytes) throw GltfError("the .glb header is cut off");
  if (word(bytes, 4) != 2) throw GltfError(fmt::format("the file has .glb version {}, not 2", word(bytes, 4)));
  const std::uint32_t length = word(bytes, 8);
  if (length > bytes.size() || length < kHeaderBytes) throw GltfError("the file is cut off");
  std::span<const std::uint8_t> rest = bytes.first(length).subspan(kHeaderBytes);
  const Chunk json = read_chunk(rest);
  if (json.type != kJsonChunk) throw GltfError("the first chunk is not JSON");
  GltfChunks chunks{as_text(json.bytes), {}};
  if (!rest.empty()) {
    const Chunk binary = read_chunk(rest);
    if (binary.type == kBinaryChunk) chunks.binary = binary.bytes;  // further chunks may follow and must be ignored
  }
  return chunks;
}

std::vector<std::uint8_t> read_uri(std::string_view uri, const std::filesystem::path& folder,
                                   std::vector<std::filesystem::path>& files) {
  if (!uri.starts_with("data:")) {
    files.push_back(referenced_file(percent_decoded(uri), folder));
    try {
      return read_file_bytes(files.back());
    } catch (const GltfError& e) {
      throw GltfError(fmt::format("the referenced file '{}' cannot be read ({})", printable_name(uri), e.what()));
    }
  }
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos || !uri.substr(0, comma).ends_with(";base64")) {
    throw GltfError("a data URI is not base64");
  }
  return decoded_base64(uri.substr(comma + 1));
}

}  // namespace gearshift::engine
