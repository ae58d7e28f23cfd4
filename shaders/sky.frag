#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared.h"
#include "tone_map.glsl"

layout(constant_id = 0) const uint features = 0u;

layout(set = 0, binding = kBindPass) uniform Pass { PassData pass; };
layout(set = 0, binding = kBindSky) uniform samplerCube sky;
layout(location = 0) in vec3 direction;
layout(location = 0) out vec4 fragment_colour;

void main() {
  vec3 radiance = texture(sky, direction).rgb;
  fragment_colour = vec4((features & kLinearOut) != 0u ? radiance : tone_map(radiance * pass.sun.w), 1.0);
}
