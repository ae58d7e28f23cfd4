// Skinning on the CPU. This is fast enough for a hand of two thousand triangles.
#pragma once

#include <span>
#include <vector>

#include "engine/model/model.h"

namespace gearshift::engine {

// Linear blend skinning (glTF 2.0, section 3.7.3.3). Position p becomes sum_i w_i J_i B_i p, where w_i is the weight of
// joint i, J_i its world matrix and B_i its inverse bind matrix. Normals and tangents use the same blended matrix. The
// result is in world space. `node` carries a mesh and a skin; `world` has one matrix per node; `out` is resized to the
// mesh's vertex_count.
void skin_vertices(const Model& model, int node, std::span<const glm::mat4> world, std::vector<Vertex>& out);

}  // namespace gearshift::engine
