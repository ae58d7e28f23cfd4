// Mirrors a model at a plane x = const, to make a right-hand-drive car from a left-hand-drive one.
#pragma once

#include <span>
#include <string_view>

#include "engine/model/model.h"

namespace gearshift::cabin {

// Moves all nodes to their mirrored places. No matrix mirrors, so that parts still turn about their own axes and a
// mirror's plane still faces its +Z; the mirroring is baked into vertices, triangles and skins. Nodes in `upright`, and
// all below them, are only moved, so that print stays readable and the steering column keeps its stalks; unknown names
// are ignored. No mesh may be used by nodes of both kinds. plane [m]
void mirror_model(engine::Model& model, float plane, std::span<const std::string_view> upright);

// Mirrors one mesh at its own x = 0.
void mirror_mesh(engine::Model& model, int mesh);

}  // namespace gearshift::cabin
