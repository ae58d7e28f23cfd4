// Checks of node transforms: matrices that a node can represent, and world matrices that can be drawn.
#pragma once

#include <glm/mat4x4.hpp>

#include "engine/model/model.h"

namespace gearshift::engine {

// Decomposes `matrix` into the node's translation, rotation and scale. False if it has shear or perspective.
bool set_node_transform(const glm::dmat4& matrix, Node& node);

// Removes the mesh from every node whose determinant in world space is zero or not a normal float, since no normal
// survives there; true if there was one. Throws GltfError if a node's world matrix is not finite.
bool drop_flat_meshes(Model& model);

}  // namespace gearshift::engine
