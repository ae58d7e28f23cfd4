// The boot: leather between the console and the lever.
#pragma once

#include <span>
#include <vector>

#include <glm/gtc/quaternion.hpp>

#include "engine/model/model.h"

namespace gearshift::cabin {

// The bottom on the console is fixed, the collar moves with the lever, and in between w = smoothstep(y / H) blends:
//   p' = p + w (P + R (p - P) - p), H = 0.058 m the collar's height, P = (0, -0.030, 0) the pivot, R the lever's turn.
// Normals and tangents follow from the derivative of that map. rest and out are in the boot's frame; out is resized.
void deform_boot(std::span<const engine::Vertex> rest, const glm::dquat& lever, std::vector<engine::Vertex>& out);

}  // namespace gearshift::cabin
