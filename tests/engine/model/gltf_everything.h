// One small file that uses every supported feature. Tests derive corrupt files from it.
#pragma once

#include "tests/engine/model/gltf_maker.h"

namespace gearshift::test {

// A skinned, textured, normal-mapped mesh of three primitives with sparse and interleaved data, a node hierarchy, two
// scenes.
inline GltfMaker everything() {
  GltfMaker maker;
  const int position = maker.accessor(triangle_corners, "VEC3", f32);
  const int normal = maker.accessor(std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", f32);
  const int uv = maker.accessor(std::vector<std::uint16_t>{0, 65535, 65535, 65535, 0, 0}, "VEC2", u16, true);
  const int colour = maker.accessor(std::vector<std::uint8_t>(12, 200), "VEC4", u8, true);
  const int joints = maker.accessor(std::vector<std::uint8_t>{0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0}, "VEC4", u8);
  const int weights = maker.accessor(std::vector<float>{1, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4", f32);
  const int indices = maker.accessor(std::vector<std::uint16_t>{0, 1, 2}, "SCALAR", u16);
  maker.root["accessors"][static_cast<std::size_t>(uv)]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", maker.view(std::vector<std::uint8_t>{1})}, {"componentType", u8}}},
      {"values", {{"bufferView", maker.view(std::vector<std::uint16_t>{65535, 0})}}}};
  const json skinned = {{"POSITION", position}, {"NORMAL", normal},   {"TEXCOORD_0", uv},
                        {"COLOR_0", colour},    {"JOINTS_0", joints}, {"WEIGHTS_0", weights}};
  json& primitive = maker.add_primitive(skinned, {{"indices", indices}, {"material", 0}});
  json strip = primitive;
  strip["mode"] = 5;
  maker.root["meshes"][0]["primitives"].push_back(strip);
  maker.append("meshes", {{"primitives", {{{"attributes", {{"POSITION", position}}}, {"mode", 6}}}}});
  maker.append("nodes", {{"name", "root"}, {"children", {0, 2}}, {"rotation", {0, 0, 0, 1}}});
  maker.append("nodes", {{"name", "tip"}, {"mesh", 1}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 1, 0, 1}}});
  maker.root["nodes"][0]["skin"] = 0;
  std::vector<float> binds(32, 0.0f);
  for (std::size_t i = 0; i < 32; i += 16) binds[i] = binds[i + 5] = binds[i + 10] = binds[i + 15] = 1.0f;
  maker.append("skins", {{"joints", {1, 2}}, {"inverseBindMatrices", maker.accessor(binds, "MAT4", f32)}});
  TempFolder folder;
  engine::write_png(folder / "dot.png", engine::Image{2, 2, std::vector<std::uint8_t>(16, 128)});
  const std::vector<std::uint8_t> png = read_bytes(folder / "dot.png");
  maker.append("images", {{"bufferView", maker.view(png)}, {"mimeType", "image/png"}});
  maker.append("images", {{"uri", data_uri(png, "image/png")}});
  maker.append("samplers", {{"wrapS", 33071}, {"magFilter", 9728}});
  maker.append("textures", {{"source", 0}, {"sampler", 0}});
  maker.append("textures", {{"source", 1}});
  const json transform = {{"KHR_texture_transform", {{"offset", {0.5, 0}}, {"scale", {2, 2}}, {"rotation", 0.5}}}};
  maker.append("materials", {{"name", "skin"},
                             {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}, {"roughnessFactor", 0.5}}},
                             {"normalTexture", {{"index", 1}, {"extensions", transform}}},
                             {"emissiveFactor", {1, 1, 1}},
                             {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 2.0}}}}}});
  maker.root["scenes"] = {{{"nodes", {1}}}, {{"nodes", {1}}}};
  maker.root["scene"] = 0;
  return maker;
}

}  // namespace gearshift::test
