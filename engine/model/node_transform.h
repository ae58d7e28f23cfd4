// Checks of node transforms: matrices that a node can represent, and world matrices that can be drawn.
#pragma once

#include <glm/mat4x4.hpp>

#include "engine/model/model.h"

namespace gearshift::engine {

// Decomposes `matrix` into the node's translation, rotation and scale. False if it has shear or perspective.
bool set_node_transform(const glm::dmat4& matrix, Node& node);

// Removes the mesh from every unskinned node whose world matrix has a determinant that is zero, subnormal or infinite,
// because it cannot transform surface normals. Returns true if any mesh was removed. Throws GltfError if a node's world
// matrix is not finite.
bool drop_flat_meshes(Model& model);

}  // namespace gearshift::engine
