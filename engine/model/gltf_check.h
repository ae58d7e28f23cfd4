// Checks those parts of a glTF 2.0 file's JSON that gltf.cpp reads: types, ranges, references, byte ranges.
#pragma once

#include <cstddef>

#include <nlohmann/json.hpp>

namespace gearshift::engine {

// `binary_bytes`: size of the binary chunk of a .glb; 0 if there is none. Throws GltfError, whose message states only
// the reason, not the file. After the function returns, all references are valid and all sizes are within the limits of
// gltf.h; the content of the buffers is still unchecked.
void check_gltf(const nlohmann::json& root, std::size_t binary_bytes);

}  // namespace gearshift::engine
