// Reads glTF 2.0, .gltf and .glb, and believes nothing in it. The only place that sees tinygltf.
#pragma once

#include <filesystem>
#include <stdexcept>

#include "engine/model/model.h"

namespace gearshift {

struct GltfError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Bounds of what is read, checked before anything is allocated.
inline constexpr std::uint64_t kMostGltfBytes = 1u << 30;      // of a file or buffer
inline constexpr std::uint64_t kMostGltfValues = 2'000'000;    // of its JSON, names included
inline constexpr std::uint64_t kMostGltfElements = 8'000'000;  // vertices or indices of a model
inline constexpr std::uint64_t kMostSkinMatrices = 65'536;     // of all skins of a scene
inline constexpr int kMostTextureSide = 8192;                  // [px]
inline constexpr std::uint64_t kMostTexturePixels = 1u << 28;  // of all textures of a file

// The nodes of the file's default scene (else its first, else all). Node and mesh names are the file's.
//
// Normals are made where a mesh has none (flat, as glTF asks for), tangents where a normal map needs them
// (MikkTSpace's convention: per-triangle derivatives, averaged by vertex). A skinned mesh is read in its bind pose.
// Mended: normals and tangents without length, factors outside their range, quaternions and weights that are not
// normalised; a mesh that its nodes' scale makes flat is not drawn. What glTF forbids beyond that refuses the file.
// Throws GltfError with one sentence: file and reason.
Model read_gltf(const std::filesystem::path& file);

}  // namespace gearshift
