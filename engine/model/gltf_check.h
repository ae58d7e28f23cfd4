// What glTF 2.0 asks of a file's JSON, as far as it is read here: types, ranges, references, byte ranges.
#pragma once

#include <cstddef>

#include <nlohmann/json.hpp>

namespace gearshift {

// binary_bytes: of the .glb's binary chunk, 0 where there is none. Throws GltfError with the reason alone. What passes
// refers to nothing that is not there and asks for no more than gltf.h allows; what the bytes say is still unchecked.
void check_gltf(const nlohmann::json& root, std::size_t binary_bytes);

}  // namespace gearshift
