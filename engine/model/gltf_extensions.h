// Supported glTF extensions.
#pragma once

#include <string_view>

namespace gearshift::engine {

inline constexpr const char* kTextureTransform = "KHR_texture_transform";
inline constexpr const char* kEmissiveStrength = "KHR_materials_emissive_strength";

inline bool is_supported_extension(std::string_view name) {
  return name == kTextureTransform || name == kEmissiveStrength;
}

}  // namespace gearshift::engine
