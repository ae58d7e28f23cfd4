#include "engine/render/material_data.h"

#include <cmath>

namespace gearshift::engine {

std::array<const TextureUse*, shader::kMaps> maps_of(const Material& material) {
  return {&material.base_colour_map, &material.metal_rough_map, &material.normal_map, &material.occlusion_map,
          &material.emissive_map};
}

std::uint32_t features_of(const Material& material, bool vertex_colours) {
  std::uint32_t features = vertex_colours ? shader::kVertexColour : 0u;
  if (material.alpha_mode == AlphaMode::mask) features |= shader::kMasked;
  if (material.alpha_mode == AlphaMode::blend) features |= shader::kBlended;
  if (material.emissive != glm::vec3(0.0f)) features |= shader::kEmits;
  const auto maps = maps_of(material);
  for (std::uint32_t map = 0; map < shader::kMaps; ++map) {
    if (maps[map]->texture == kNone) continue;
    features |= shader::kHasMap << map;
    if (maps[map]->uv_set == 1) features |= shader::kMapOnUv1 << map;
    if (!maps[map]->plain()) features |= shader::kTransformedUv;
  }
  return features;
}

shader::MaterialData data_of(const Material& material) {
  shader::MaterialData data{};
  data.base_colour = material.base_colour;
  data.emissive = glm::vec4(material.emissive, material.normal_scale);
  data.surface = {material.metallic, material.roughness, material.occlusion_strength, material.alpha_cutoff};
  const auto maps = maps_of(material);
  for (std::uint32_t map = 0; map < shader::kMaps; ++map) {
    // A positive rotation is counter-clockwise when v points down, as in other glTF loaders (KhronosGroup/glTF issue
    // 1563).
    const float c = std::cos(maps[map]->rotation), s = std::sin(maps[map]->rotation);
    const glm::vec2 scale = maps[map]->scale;
    data.uv_matrix[map] = {c * scale.x, -s * scale.x, s * scale.y, c * scale.y};
    data.uv_offset[map] = glm::vec4(maps[map]->offset, 0.0f, 0.0f);
  }
  return data;
}

}  // namespace gearshift::engine
