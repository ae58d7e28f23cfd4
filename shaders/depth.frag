#version 460
#extension GL_GOOGLE_include_directive : require
// Discards the same fragments of a masked material as mesh.frag, so that light passes through the material's holes.
#include "shared.h"

layout(constant_id = 0) const uint features = 0u;

layout(set = 1, binding = kMapBaseColour) uniform sampler2D base_colour_map;
layout(set = 1, binding = kBindMaterial) uniform Material { MaterialData material; };
layout(location = 0) in vec2 uv;
layout(location = 1) in float alpha;

void main() {
  float cover = material.base_colour.a;
  if ((features & kVertexColour) != 0u) cover *= alpha;
  if ((features & (kHasMap << kMapBaseColour)) != 0u) {
    vec4 m = material.uv_matrix[kMapBaseColour];
    cover *= texture(base_colour_map, m.xy * uv.x + m.zw * uv.y + material.uv_offset[kMapBaseColour].xy).a;
  }
  if (cover < material.surface.w) discard;
}
