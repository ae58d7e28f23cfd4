// Reads glTF 2.0 (.gltf and .glb) from untrusted files. The only room that uses tinygltf.
#pragma once

#include <filesystem>
#include <stdexcept>

#include "engine/model/model.h"

namespace gearshift::engine {

struct GltfError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Limits, checked before anything is allocated.
inline constexpr std::uint64_t kMaxGltfBytes = 1u << 30;      // per file or buffer
inline constexpr std::uint64_t kMaxGltfValues = 2'000'000;    // in the JSON, names included
inline constexpr std::uint64_t kMaxGltfElements = 8'000'000;  // vertices or indices per model
inline constexpr std::uint64_t kMaxSkinMatrices = 65'536;     // over all skins of a scene
inline constexpr int kMaxTextureSide = 8192;                  // [px]
inline constexpr std::uint64_t kMaxTexturePixels = 1u << 28;  // over all textures of a file

// Reads the nodes of the file's default scene (or its first scene, or all nodes if there is none). Node and mesh names
// are those in the file.
//
// Missing normals are generated (flat, as glTF requires), as are tangents if a normal map needs them (MikkTSpace's
// convention: per-triangle derivatives, averaged per vertex). A skinned mesh is read in its bind pose.
// Repaired: normals and tangents of zero length, factors out of range, quaternions and weights that are not normalised.
// A mesh flattened by the scale of its nodes is not drawn. Anything else that glTF forbids rejects the file: throws
// GltfError with one sentence, file and reason.
Model read_gltf(const std::filesystem::path& file);

}  // namespace gearshift::engine
