// Skinning on the CPU, which suffices for a hand of two thousand triangles.
#pragma once

#include <span>
#include <vector>

#include "engine/model/model.h"

namespace gearshift::engine {

// Linear blend skinning (glTF 2.0, 3.7.3.3): p' = sum_i w_i J_i B_i p, where J is the joint's world matrix and B its
// inverse bind matrix; normals and tangents use the same matrix. The result is in world space. `node` carries a mesh
// and a skin; world has one matrix per node; out is resized to the mesh's vertex_count.
void skin_vertices(const Model& model, int node, std::span<const glm::mat4> world, std::vector<Vertex>& out);

}  // namespace gearshift::engine
