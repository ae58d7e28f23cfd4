// Builds small glTF files with known content, as text or .glb.
#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "engine/model/gltf.h"
#include "tests/support/temp_folder.h"

namespace gearshift::test {

using nlohmann::json;

inline std::string base64(const std::vector<std::uint8_t>& bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k) three = three << 8 | (i + k < bytes.size() ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : digits[three >> (18 - 6 * k) & 63];
  }
  return text;
}

inline std::string data_uri(const std::vector<std::uint8_t>& bytes,
                            const std::string& kind = "application/octet-stream") {
  return "data:" + kind + ";base64," + base64(bytes);
}

inline void write_bytes(const std::filesystem::path& file, std::string_view bytes) {
  std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

inline std::vector<std::uint8_t> read_bytes(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// glTF's component types.
enum : int { i8 = 5120, u8 = 5121, i16 = 5122, u16 = 5123, u32 = 5125, f32 = 5126 };

struct GltfMaker {
  json root = {{"asset", {{"version", "2.0"}}}};
  std::vector<std::uint8_t> bytes;

  int append(const char* list, json value) {
    root[list].push_back(std::move(value));
    return static_cast<int>(root[list].size()) - 1;
  }

  template <typename T>
  int view(const std::vector<T>& values) {
    const std::size_t offset = bytes.size(), size = values.size() * sizeof(T);
    bytes.resize(offset + (size + 3) / 4 * 4);  // each buffer view starts at a multiple of 4
    std::memcpy(bytes.data() + offset, values.data(), size);
    return append("bufferViews", {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", size}});
  }

  // `values`: all components of all elements, in order.
  template <typename T>
  int accessor(const std::vector<T>& values, const std::string& type, int component, bool normalized = false) {
    const std::size_t components = type == "SCALAR" ? 1 : type == "MAT4" ? 16 : static_cast<std::size_t>(type[3] - '0');
    json item = {{"bufferView", view(values)},
                 {"componentType", component},
                 {"count", values.size() / components},
                 {"type", type}};
    if (normalized) item["normalized"] = true;
    return append("accessors", item);
  }

  // Adds a node with a mesh of one primitive.
  json& add_primitive(json attributes, json more = json::object()) {
    more["attributes"] = std::move(attributes);
    const int mesh = append("meshes", {{"name", "mesh"}, {"primitives", json::array({more})}});
    append("nodes", {{"name", "node"}, {"mesh", mesh}});
    return root["meshes"][static_cast<std::size_t>(mesh)]["primitives"][0];
  }

  std::string gltf() const {
    json document = root;
    if (!bytes.empty()) document["buffers"] = {{{"byteLength", bytes.size()}, {"uri", data_uri(bytes)}}};
    return document.dump();
  }

  std::string glb() const {
    json document = root;
    if (!bytes.empty()) document["buffers"] = {{{"byteLength", bytes.size()}}};
    std::string text = document.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string file = "glTF" + little_endian(2) + little_endian(0) + little_endian(text.size()) + "JSON" + text;
    if (!bytes.empty())
      file += little_endian(bytes.size()) + std::string("BIN\0", 4) + std::string(bytes.begin(), bytes.end());
    return file.replace(8, 4, little_endian(file.size()));
  }

  static std::string little_endian(std::size_t value) {
    const auto bits = static_cast<std::uint32_t>(value);
    std::string text(4, '\0');
    std::memcpy(text.data(), &bits, 4);
    return text;
  }
};

// The triangle (0,0,0) (1,0,0) (0,1,0), facing +Z.
inline const std::vector<float> triangle_corners{0, 0, 0, 1, 0, 0, 0, 1, 0};

inline GltfMaker triangle() {
  GltfMaker maker;
  maker.add_primitive({{"POSITION", maker.accessor(triangle_corners, "VEC3", f32)}});
  return maker;
}

inline engine::Model read_back(const std::string& content, const TempFolder& folder = TempFolder()) {
  write_bytes(folder / "model.gltf", content);
  return engine::read_gltf(folder / "model.gltf");
}

inline engine::Model read_back(const GltfMaker& maker) {
  return read_back(maker.gltf());
}

}  // namespace gearshift::test
