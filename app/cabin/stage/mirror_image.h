// Mirrors a model at a plane x = const to make a right-hand-drive car from a left-hand-drive one.
#pragma once

#include <span>
#include <string_view>

#include "engine/model/model.h"

namespace gearshift::cabin {

// Moves all nodes to their mirrored places. The mirroring is baked into vertices, triangles and skins, not into the
// nodes' matrices, so that parts still turn about their own axes and a mirror's plane still faces its +Z. The nodes in
// `upright`, and all nodes below them, are moved but not mirrored, so that print stays readable and the steering
// column's stalks stay on their sides; unknown names are ignored. No mesh may be used by both a mirrored and an upright
// node. plane [m]: x of the plane.
void mirror_model(engine::Model& model, float plane, std::span<const std::string_view> upright);

// Mirrors one mesh at the plane x = 0 of the mesh.
void mirror_mesh(engine::Model& model, int mesh);

}  // namespace gearshift::cabin
