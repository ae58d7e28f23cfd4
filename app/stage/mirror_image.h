// A model as a mirror at x = const shows it, for a right-hand-drive car out of a left-hand-drive one.
#pragma once

#include <span>
#include <string_view>

#include "engine/model/model.h"

namespace gearshift {

// Node and all below it stand where the mirror shows them; no matrix mirrors, so that a part still turns about its own
// axes and a mirror's plane still faces its +Z: what mirrors is baked into vertices, triangles and skins. A node of
// `upright`, and all below it, is only moved: print reads, a wheel keeps its stalks. Names that the model lacks are
// passed over. No mesh hangs on nodes of both kinds. plane [m]
void mirror_model(Model& model, float plane, std::span<const std::string_view> upright);

// One mesh, at its own x = 0.
void mirror_mesh(Model& model, int mesh);

}  // namespace gearshift
