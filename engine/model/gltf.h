// Reads glTF 2.0 (.gltf and .glb) from untrusted files. Only gltf.cpp uses tinygltf.
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
inline constexpr std::uint64_t kMaxGltfValues = 2'000'000;    // values in the JSON, including names
inline constexpr std::uint64_t kMaxGltfElements = 8'000'000;  // vertices or indices per model
inline constexpr std::uint64_t kMaxSkinMatrices = 65'536;     // matrices in all skins of a scene
inline constexpr int kMaxTextureSide = 8192;                  // [px]
inline constexpr std::uint64_t kMaxTexturePixels = 1u << 28;  // pixels in all textures of a file

// Reads the nodes of the default scene, of the first scene if none is the default, or all nodes if the file has no
// scene. Node and mesh names are those in the file.
//
// Missing normals are generated (flat, as glTF requires). Missing tangents are generated if a normal map needs them
// (MikkTSpace's convention: per-triangle derivatives, averaged per vertex). A skinned mesh is read in its bind pose.
// These faults are repaired: normals and tangents of zero length, factors out of range, quaternions and weights that
// are not normalised. A mesh is not drawn if its world matrix has a scale that is zero or out of range. Any other
// violation of glTF rejects the file: throws GltfError with one sentence that names file and reason.
Model read_gltf(const std::filesystem::path& file);

}  // namespace gearshift::engine
