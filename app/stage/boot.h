// The boot: leather between the console and the lever.
#pragma once

#include <span>
#include <vector>

#include <glm/gtc/quaternion.hpp>

#include "engine/model/model.h"

namespace gearshift {

// Its seat on the console stands still, its collar goes with the lever, and between them w = smoothstep(y / H):
//   p' = p + w (P + R (p - P) - p), H = 0.058 m the collar's height, P = (0, -0.030, 0) the pivot, R the lever.
// Normals and tangents by the derivative of that map. rest and out: in the boot's own frame, equally many.
void deform_boot(std::span<const Vertex> rest, const glm::dquat& lever, std::vector<Vertex>& out);

}  // namespace gearshift
