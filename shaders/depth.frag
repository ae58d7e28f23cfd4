#version 460
#extension GL_GOOGLE_include_directive : require
// The holes of a masked material: light falls through them.
#include "shared.h"

layout(constant_id = 0) const uint features = 0u;

layout(set = 1, binding = kMapBaseColour) uniform sampler2D base_colour_map;
layout(set = 1, binding = kBindMaterial) uniform Material { MaterialData material; };
layout(location = 0) in vec2 uv;

void main() {
  vec4 m = material.uv_matrix[kMapBaseColour];
  vec2 at = m.xy * uv.x + m.zw * uv.y + material.uv_offset[kMapBaseColour].xy;
  if (material.base_colour.a * texture(base_colour_map, at).a < material.surface.w) discard;
}
