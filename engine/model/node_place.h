// Where nodes may stand: matrices that a node can hold, and worlds that can be drawn.
#pragma once

#include <glm/mat4x4.hpp>

#include "engine/model/model.h"

namespace gearshift {

// Translation, rotation and scale of `matrix` into the node. False where there are none: shear, perspective.
bool place_by_matrix(const glm::dmat4& matrix, Node& node);

// Takes the mesh from every node whose volume in the world is no number that a float holds, zero included, since no
// normal survives there; true where there was one. Throws GltfError where a node's world matrix is not finite.
bool drop_flat_meshes(Model& model);

}  // namespace gearshift
