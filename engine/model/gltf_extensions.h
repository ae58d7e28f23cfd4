// The extensions of glTF that are read.
#pragma once

#include <string_view>

namespace gearshift {

inline constexpr const char* kTextureTransform = "KHR_texture_transform";
inline constexpr const char* kEmissiveStrength = "KHR_materials_emissive_strength";

inline bool knows_extension(std::string_view name) {
  return name == kTextureTransform || name == kEmissiveStrength;
}

}  // namespace gearshift
