// Checks whether a node can represent a given matrix, and whether a mesh can be drawn with a given world matrix.
#pragma once

#include <glm/mat4x4.hpp>

#include "engine/model/model.h"

namespace gearshift::engine {

// Decomposes `matrix` into the node's translation, rotation and scale. Returns false if the matrix has shear or
// perspective.
bool set_node_transform(const glm::dmat4& matrix, Node& node);

// Removes the mesh from every unskinned node whose world matrix has a zero, subnormal or infinite determinant, because
// such a matrix cannot transform surface normals. Returns true if any mesh was removed. Throws GltfError if a node's
// world matrix is not finite.
bool drop_flat_meshes(Model& model);

}  // namespace gearshift::engine
