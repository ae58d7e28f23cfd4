// What GLSL and C++ must agree on: bindings, structs, limits, and which switch is which bit.
// Structs hold nothing but vec4 and mat4, so that std140 and C++ lay them out alike.
#ifndef GEARSHIFT_SHADERS_SHARED_H
#define GEARSHIFT_SHADERS_SHARED_H

#ifdef __cplusplus
#include <cstdint>

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
namespace gearshift::shader {
using glm::mat4;
using glm::vec4;
using uint = std::uint32_t;
#define SHARED inline constexpr
#else
#define SHARED const
#endif

// Set 0, one a pass and frame.
SHARED uint kBindPass = 0u;         // PassData
SHARED uint kBindObjects = 1u;      // ObjectData, one a node
SHARED uint kBindReflections = 2u;  // cube, prefiltered by roughness
SHARED uint kBindBrdf = 3u;         // scale and bias of F0 over (n.v, roughness)
SHARED uint kBindShadow = 4u;       // depth, seen from the sun
SHARED uint kBindMirror = 5u;       // what the mirror shows, a layer an eye
SHARED uint kBindSky = 6u;          // cube, sharp
SHARED uint kBindIndoors = 7u;      // cube as kBindReflections, of what stands indoors

// Set 1, one a material: five textures and its numbers.
SHARED uint kMapBaseColour = 0u;
SHARED uint kMapMetalRough = 1u;
SHARED uint kMapNormal = 2u;
SHARED uint kMapOcclusion = 3u;
SHARED uint kMapEmissive = 4u;
SHARED uint kMaps = 5u;
SHARED uint kBindMaterial = 5u;  // MaterialData

// Specialization constant 0: what a pipeline has to do. A material without a map costs no sampling.
SHARED uint kHasMap = 1u;  // << kMap...: that map is there
SHARED uint kAllMaps = 31u;
SHARED uint kMapOnUv1 = 1u << 5;        // << kMap...: and lies on the second set
SHARED uint kTransformedUv = 1u << 10;  // some map has a KHR_texture_transform
SHARED uint kVertexColour = 1u << 11;
SHARED uint kMasked = 1u << 12;   // alpha below the cutoff is a hole
SHARED uint kBlended = 1u << 13;  // alpha is written: glass and ghosts
SHARED uint kEmits = 1u << 14;
SHARED uint kShadowed = 1u << 15;     // the sun's shadow is looked up
SHARED uint kShowsMirror = 1u << 16;  // reflects the mirror's picture, not the surroundings
SHARED uint kLinearOut = 1u << 17;    // radiance is written as it is: no tone mapping
SHARED uint kIndoors = 1u << 18;      // lit by what a point inside sees, not by the open sky

// Specialization constants 1 to 27: irradiance over pi, of the open sky or indoors, as a polynomial in the normal, see
// irradiance() in mesh.frag. It changes with the light, hardly ever, and a software driver is slow at reading 27
// uniforms a pixel.
SHARED uint kIrradianceTerms = 9u;

SHARED uint kReflectionLevels = 6u;  // of the cube, roughness 0 to 1

struct PassData {
  mat4 clip_from_world[2];  // by eye; of the shadow's pass: the sun's
  vec4 eye[2];              // xyz [m] world
  vec4 sky_centre[2];       // direction seen at clip (x, y): centre + x right + y down
  vec4 sky_right[2];
  vec4 sky_down[2];
  mat4 shadow_from_world;  // (u, v, depth)
  vec4 shadow_texel;       // x: [m] a texel's width; y: texels a side
  vec4 mirror_u;           // texture coordinates of the mirror's picture: dot(mirror_u, (world, 1))
  vec4 mirror_v;
  vec4 towards_sun;  // xyz unit
  vec4 sun;          // rgb irradiance; w exposure
};

struct ObjectData {
  mat4 world;
  vec4 normal[3];  // columns of the matrix for normals; normal[0].w: -1 where the node mirrors, else 1
  vec4 uv_shift;   // xy
};

struct MaterialData {
  vec4 base_colour;
  vec4 emissive;          // rgb; w: scale of the normal map
  vec4 surface;           // metallic, roughness, strength of the occlusion, alpha's cutoff
  vec4 uv_matrix[kMaps];  // columns of a 2x2
  vec4 uv_offset[kMaps];  // xy
};

struct DrawData {
  uint object;
  float emission;  // factor on the material's
  float opacity;
  float thin;  // 1: both faces are shown, else 0
};

#ifdef __cplusplus
}  // namespace gearshift::shader
#endif
#endif
