// Metallic-roughness surface lit by a sky and a sun.
//
// This work is based on:
// Khronos. glTF 2.0 Specification, appendix B (BRDF)
// Eric Heitz. Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs. 2014 (visibility, eq. 99)
// Brian Karis. Real Shading in Unreal Engine 4. 2013 (split sum)
// Sebastien Lagarde, Charles de Rousiers. Moving Frostbite to Physically Based Rendering. 2014 (specular occlusion)
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared.h"
#include "tone_map.glsl"

layout(constant_id = 0) const uint features = 0u;
#define SKY_TERM(i, r, g, b)                            \
  layout(constant_id = r) const float sky_r##i = 0.0;   \
  layout(constant_id = g) const float sky_g##i = 0.0;   \
  layout(constant_id = b) const float sky_b##i = 0.0;
SKY_TERM(0, 1, 2, 3)
SKY_TERM(1, 4, 5, 6)
SKY_TERM(2, 7, 8, 9)
SKY_TERM(3, 10, 11, 12)
SKY_TERM(4, 13, 14, 15)
SKY_TERM(5, 16, 17, 18)
SKY_TERM(6, 19, 20, 21)
SKY_TERM(7, 22, 23, 24)
SKY_TERM(8, 25, 26, 27)
#define SKY(i) vec3(sky_r##i, sky_g##i, sky_b##i)

layout(set = 0, binding = kBindPass) uniform Pass { PassData pass; };
layout(set = 0, binding = kBindReflections) uniform samplerCube reflections;
layout(set = 0, binding = kBindBrdf) uniform sampler2D brdf;
layout(set = 0, binding = kBindShadow) uniform sampler2DShadow shadow;
layout(set = 0, binding = kBindIndoors) uniform samplerCube reflections_indoors;
layout(set = 0, binding = kBindMirror) uniform sampler2DArray mirror;
layout(set = 1, binding = kMapBaseColour) uniform sampler2D base_colour_map;
layout(set = 1, binding = kMapMetalRough) uniform sampler2D metal_rough_map;
layout(set = 1, binding = kMapNormal) uniform sampler2D normal_map;
layout(set = 1, binding = kMapOcclusion) uniform sampler2D occlusion_map;
layout(set = 1, binding = kMapEmissive) uniform sampler2D emissive_map;
layout(set = 1, binding = kBindMaterial) uniform Material { MaterialData material; };
layout(push_constant) uniform Draw { DrawData draw; };

layout(location = 0) in vec3 to_eye;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 uv;
layout(location = 3) in vec3 lookup;
layout(location = 4) in vec4 tangent;
layout(location = 5) in vec4 colour;
layout(location = 6) flat in uint eye;

layout(location = 0) out vec4 fragment_colour;

const float kPi = 3.14159265;
const float kDielectricF0 = 0.04;
const float kMinSunRoughness = 0.06;  // smallest roughness for the sun's highlight, because the sun is not a point

bool has(uint feature) { return (features & feature) != 0u; }

vec2 uv_of(uint map) {
  vec2 at = has(kMapOnUv1 << map) ? uv.zw : uv.xy;
  if (!has(kTransformedUv)) return at;
  vec4 m = material.uv_matrix[map];
  return m.xy * at.x + m.zw * at.y + material.uv_offset[map].xy;
}

vec3 shading_normal() {
  vec3 n = normalize(gl_FrontFacing ? normal : -normal);
  if (!has(kHasMap << kMapNormal)) return n;
  vec2 slope = material.emissive.w * (2.0 * texture(normal_map, uv_of(kMapNormal)).xy - 1.0);
  vec3 across = cross(normal, tangent.xyz) * tangent.w;
  vec3 bent = tangent.xyz * slope.x + across * slope.y;
  return normalize(n * sqrt(max(1.0 - dot(slope, slope), 0.01)) + (gl_FrontFacing ? bent : -bent));
}

// Irradiance / pi for a normal: spherical harmonics up to degree 2, written as a polynomial.
vec3 irradiance(vec3 n) {
  vec3 e = SKY(0) + SKY(1) * n.y + SKY(2) * n.z + SKY(3) * n.x;
  e += (SKY(4) * n.x + SKY(5) * n.z) * n.y + SKY(6) * (n.z * n.z) + SKY(7) * (n.x * n.z) +
       SKY(8) * (n.x * n.x - n.y * n.y);
  return max(e, vec3(0.0));
}

vec3 surroundings(vec3 direction, float roughness) {
  float level = roughness * float(kReflectionLevels - 1u);
  return has(kIndoors) ? textureLod(reflections_indoors, direction, level).rgb
                       : textureLod(reflections, direction, level).rgb;
}

// Fraction of the sun's light that reaches the surface: the mean, over 3x3 texels, of bilinearly weighted depth
// comparisons. Four gathers supply the 4x4 comparisons for this. The shader applies the weights itself, because drivers
// need not filter depth comparisons.
float sunlit() {
  float side = pass.shadow_texel.y, depth = max(lookup.z, 0.0);
  vec2 at = lookup.xy * side - 0.5, texel = floor(at), f = at - texel, e = 1.0 - f;
  vec4 low = vec4(texel, texel + 2.0) / side;  // points where four texels meet: low.xy and low.zw
  vec4 a = textureGather(shadow, low.xy, depth), b = textureGather(shadow, low.zy, depth);
  vec4 c = textureGather(shadow, low.xw, depth), d = textureGather(shadow, low.zw, depth);
  float rows = dot(vec4(e.x, 1.0, 1.0, f.x), vec4(a.x, a.y, b.x, b.y) + vec4(c.w, c.z, d.w, d.z));
  float above = dot(vec4(e.x, 1.0, 1.0, f.x), vec4(a.w, a.z, b.w, b.z));
  float below = dot(vec4(e.x, 1.0, 1.0, f.x), vec4(c.x, c.y, d.x, d.y));
  return (rows + e.y * above + f.y * below) * (1.0 / 9.0);
}

void main() {
  vec4 base = material.base_colour;
  if (has(kVertexColour)) base *= colour;
  if (has(kHasMap << kMapBaseColour)) base *= texture(base_colour_map, uv_of(kMapBaseColour));
  if (has(kMasked) && base.a < material.surface.w) discard;

  float metallic = material.surface.x, roughness = material.surface.y;
  if (has(kHasMap << kMapMetalRough)) {
    vec2 factor = texture(metal_rough_map, uv_of(kMapMetalRough)).bg;
    metallic *= factor.x;
    roughness *= factor.y;
  }
  vec3 f0 = mix(vec3(kDielectricF0), base.rgb, metallic);

  vec3 n = shading_normal(), v = normalize(to_eye);
  float n_dot_v = clamp(dot(n, v), 1e-3, 1.0);

  // Light from the sky, by the split-sum approximation. Light that is not reflected enters the surface.
  vec2 ab = texture(brdf, vec2(n_dot_v, roughness)).xy;
  vec3 reflectance = f0 * ab.x + ab.y;
  vec3 diffuse = base.rgb * (1.0 - metallic) * (1.0 - reflectance);
  vec3 environment = has(kShowsMirror) ? texture(mirror, lookup).rgb : surroundings(reflect(-v, n), roughness);
  vec3 reflected = environment * reflectance;
  vec3 scattered = irradiance(n) * diffuse;
  if (has(kHasMap << kMapOcclusion)) {
    float open = mix(1.0, texture(occlusion_map, uv_of(kMapOcclusion)).r, material.surface.z);
    scattered *= open;
    reflected *= clamp(pow(n_dot_v + open, exp2(-16.0 * roughness - 1.0)) - 1.0 + open, 0.0, 1.0);
  }

  // Light from the sun.
  vec3 l = pass.towards_sun.xyz;
  float n_dot_l = max(dot(n, l), 0.0);
  vec3 h = normalize(l + v);
  float n_dot_h = max(dot(n, h), 0.0), away = 1.0 - max(dot(v, h), 0.0);
  float alpha = max(roughness, kMinSunRoughness);
  alpha *= alpha;
  float a2 = alpha * alpha, d = n_dot_h * n_dot_h * (a2 - 1.0) + 1.0;
  float visibility = 0.5 / (n_dot_l * sqrt(n_dot_v * n_dot_v * (1.0 - a2) + a2) +
                            n_dot_v * sqrt(n_dot_l * n_dot_l * (1.0 - a2) + a2));
  float away2 = away * away;
  vec3 fresnel = f0 + (1.0 - f0) * (away2 * away2 * away);
  vec3 incident = pass.sun.rgb * n_dot_l;
  if (has(kShadowed) && !has(kShowsMirror)) incident *= sunlit();
  reflected += incident * fresnel * (visibility * a2 / (kPi * d * d));
  scattered += incident * diffuse * (1.0 / kPi);

  if (has(kEmits)) {
    vec3 emissive = material.emissive.rgb * draw.emission;
    if (has(kHasMap << kMapEmissive)) emissive *= texture(emissive_map, uv_of(kMapEmissive)).rgb;
    scattered += emissive;
  }

  // Glass transmits only light that it does not reflect, so its coverage grows with the reflectance towards grazing
  // angles. The radiance is divided by the coverage, so that blending does not dim the reflection.
  float cover = 1.0;
  vec3 radiance = scattered + reflected;
  if (has(kBlended)) {
    float mirror_like = max(reflectance.r, max(reflectance.g, reflectance.b));
    cover = base.a + (1.0 - base.a) * mirror_like;
    radiance = (scattered * base.a + reflected) / max(cover, 1e-3);
    cover *= draw.opacity;
  }
  fragment_colour = vec4(has(kLinearOut) ? radiance : tone_map(radiance * pass.sun.w), cover);
}
