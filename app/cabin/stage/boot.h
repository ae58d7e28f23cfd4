// The boot: the leather cover between the console and the lever.
#pragma once

#include <span>
#include <vector>

#include <glm/gtc/quaternion.hpp>

#include "engine/model/model.h"

namespace gearshift::cabin {

// Bends the boot. Its bottom on the console is fixed, and its collar moves with the lever. Between them, the weight w =
// smoothstep(y / H) blends the position p at rest with the rotated one: p' = p + w (P + R (p - P) - p), with the
// collar's height H = 0.058 m, the pivot P = (0, -0.030, 0) m and the lever's rotation R. Normals and tangents follow
// from the derivative of this map. rest and out are in the boot's frame; out is resized.
void deform_boot(std::span<const engine::Vertex> rest, const glm::dquat& lever, std::vector<engine::Vertex>& out);

}  // namespace gearshift::cabin
