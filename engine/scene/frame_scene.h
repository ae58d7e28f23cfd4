// Everything that can change from frame to frame.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/model/model.h"

namespace gearshift::engine {

struct NodeState {
  glm::mat4 world{1.0f};
  float emissive = 1.0f;     // factor on the material's emission; a lamp is off at 0
  glm::vec2 uv_shift{0.0f};  // added to uv0, e.g. to select another field of a display's atlas
  float opacity = 1.0f;      // factor on alpha; below 1 the node is blended, e.g. for a ghost
  bool visible = true;
  bool indoors = false;  // lit by the indoor environment instead of the open sky
};

struct Sun {
  glm::vec3 towards{0.35f, 0.80f, -0.48f};  // direction to the sun, normalised when used
  glm::vec3 irradiance{3.2f, 3.0f, 2.7f};   // on a surface facing the sun, in units of the sky's radiance
};

// New vertices for a mesh of the model, for one node or for all nodes that carry it.
struct DeformedMesh {
  int mesh = kNone;
  std::vector<Vertex> vertices;  // Mesh::vertex_count entries
  int node = kNone;              // kNone: all nodes that carry the mesh
};

// Shadows are computed only inside this box [m, world space]. A smaller box gives sharper shadows.
struct ShadowBounds {
  glm::vec3 low{-std::numeric_limits<float>::max()}, high{std::numeric_limits<float>::max()};
};

// Content of one frame. If there is a mirror, it is the plane z = 0 of its node, and its +Z side reflects.
struct FrameScene {
  std::vector<NodeState> nodes;        // one per node of the model
  std::vector<DeformedMesh> deformed;  // may be empty
  Sun sun;
  float exposure = 1.0f;
  int mirror = kNone;  // node whose mesh is the mirror
  ShadowBounds shadow_bounds;
};

}  // namespace gearshift::engine
