// Definitions common to GLSL and C++: bindings, structs, limits, feature bits. Structs in buffers contain only vec4 and
// mat4, so that std140 and C++ have the same layout.
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

// Set 0: one per pass and frame.
SHARED uint kBindPass = 0u;         // PassData
SHARED uint kBindObjects = 1u;      // ObjectData, one per node
SHARED uint kBindReflections = 2u;  // cube of reflections, prefiltered by roughness
SHARED uint kBindBrdf = 3u;         // scale and bias of the reflectance F0, by (n.v, roughness)
SHARED uint kBindShadow = 4u;       // depth map, seen from the sun
SHARED uint kBindMirror = 5u;       // the mirror's picture, one layer per eye
SHARED uint kBindSky = 6u;          // cube, unfiltered
SHARED uint kBindIndoors = 7u;      // like kBindReflections, for indoor nodes

// Set 1: one per material, with five textures and MaterialData.
SHARED uint kMapBaseColour = 0u;
SHARED uint kMapMetalRough = 1u;
SHARED uint kMapNormal = 2u;
SHARED uint kMapOcclusion = 3u;
SHARED uint kMapEmissive = 4u;
SHARED uint kMaps = 5u;
SHARED uint kBindMaterial = 5u;  // MaterialData

// Specialization constant 0: features of a pipeline, as bits. The shader samples only maps that the material has.
SHARED uint kHasMap = 1u;  // kHasMap << kMapNormal: the material has a normal map
SHARED uint kAllMaps = 31u;
SHARED uint kMapOnUv1 = 1u << 5;        // kMapOnUv1 << kMapNormal: the normal map uses uv1
SHARED uint kTransformedUv = 1u << 10;  // at least one map uses KHR_texture_transform
SHARED uint kVertexColour = 1u << 11;
SHARED uint kMasked = 1u << 12;   // fragments with alpha below the cutoff are discarded
SHARED uint kBlended = 1u << 13;  // alpha is written, for glass and ghosts
SHARED uint kEmits = 1u << 14;
SHARED uint kShadowed = 1u << 15;     // looks up the sun's shadow
SHARED uint kShowsMirror = 1u << 16;  // reflects the mirror's picture instead of the environment
SHARED uint kLinearOut = 1u << 17;    // writes linear radiance, without tone mapping
SHARED uint kIndoors = 1u << 18;      // lit by the indoor environment instead of the open sky

// Specialization constants 1 to 27: irradiance / pi, outdoors or indoors, as a polynomial in the normal (9 terms for
// each of 3 colours), see irradiance() in mesh.frag. They are not uniforms, because the light rarely changes, and a
// software driver is slow at reading 27 uniforms per pixel.
SHARED uint kIrradianceTerms = 9u;

SHARED uint kReflectionLevels = 6u;  // number of mip levels of the reflection cube, from roughness 0 to 1

struct PassData {
  mat4 clip_from_world[2];  // one per eye; the shadow pass uses only the first, for the sun
  vec4 eye[2];              // xyz [m] world
  vec4 sky_centre[2];       // direction at clip (x, y): sky_centre + x sky_right + y sky_down
  vec4 sky_right[2];
  vec4 sky_down[2];
  mat4 shadow_from_world;  // (u, v, depth)
  vec4 shadow_texel;       // x: [m] width of a texel; y: texels per side
  vec4 mirror_u;           // u in the mirror's picture is dot(mirror_u, (world, 1))
  vec4 mirror_v;
  vec4 towards_sun;  // xyz unit vector
  vec4 sun;          // rgb irradiance; w exposure
};

struct ObjectData {
  mat4 world;
  vec4 normal[3];  // columns of the normal matrix; normal[0].w: -1 if `world` mirrors the node, else 1
  vec4 uv_shift;   // xy
};

struct MaterialData {
  vec4 base_colour;
  vec4 emissive;          // rgb; w: scale of the normal map
  vec4 surface;           // metallic, roughness, occlusion strength, alpha cutoff
  vec4 uv_matrix[kMaps];  // columns of a 2x2 matrix
  vec4 uv_offset[kMaps];  // xy
};

struct DrawData {
  uint object;
  float emission;  // factor for the material's emission
  float opacity;
  float thin;  // 1: both faces are visible, else 0
};

#ifdef __cplusplus
}  // namespace gearshift::shader
#endif
#endif
