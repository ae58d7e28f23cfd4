// All that changes from frame to frame.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/model/model.h"

namespace gearshift {

struct NodeState {
  glm::mat4 world{1.0f};
  float emissive = 1.0f;     // factor on the material's emission: a lamp is off at 0
  glm::vec2 uv_shift{0.0f};  // added to uv0: a display shows another field of its atlas
  float opacity = 1.0f;      // factor on alpha; below 1 the node is drawn blended: a ghost
  bool visible = true;
  bool indoors = false;  // lit by what a point inside sees, not by the open sky
};

struct Sun {
  glm::vec3 towards{0.35f, 0.80f, -0.48f};  // unit vector is made of it
  glm::vec3 irradiance{3.2f, 3.0f, 2.7f};   // on a surface that faces it, in units of the sky's radiance
};

// A deformed mesh: new vertices for a mesh of the model, from its first_vertex on, on one node or on all that carry it.
struct DeformedMesh {
  int mesh = kNone;
  std::vector<Vertex> vertices;  // Mesh::vertex_count of them
  int node = kNone;              // kNone: all
};

// A box outside of which nothing is in shadow: the smaller, the sharper the shadows in it. [m] world
struct ShadowRoom {
  glm::vec3 low{-std::numeric_limits<float>::max()}, high{std::numeric_limits<float>::max()};
};

// A mirror: the plane z = 0 of that node, seen from its +Z side.
struct FrameScene {
  std::vector<NodeState> nodes;        // one a node of the model
  std::vector<DeformedMesh> deformed;  // may be empty
  Sun sun;
  float exposure = 1.0f;
  int mirror = kNone;  // node whose mesh shows what its plane mirrors
  ShadowRoom shadow_room;
};

}  // namespace gearshift
