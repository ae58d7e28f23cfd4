// Forces of the mechanism on a lever inside the aisles: centring, mouth bump, detent, lock and buffers.
#pragma once

#include <glm/vec2.hpp>

#include "haptics/gate/gate.h"

namespace gearshift::haptics {

// The slot that contains the point; kNoSlot if the point is in the neutral aisle or, in a mechanism, between places.
int slot_at(const Gate& gate, glm::dvec2 point) noexcept;

// Force [N] on the lever when the proxy is at this point of free space: the negative gradient of a potential, so that no
// closed path supplies energy.
glm::dvec2 gate_feel(const Gate& gate, glm::dvec2 proxy) noexcept;

// Largest restoring stiffness [N/m] of the mechanism anywhere in the gate. The coupling must not be softer.
double max_feel_stiffness(const Gate& gate) noexcept;

}  // namespace gearshift::haptics
