// Forces of the mechanism on a lever inside its aisles: centring, mouth bump, detent, lock, buffers.
#pragma once

#include <glm/vec2.hpp>

#include "haptics/gate/gate.h"

namespace gearshift::haptics {

// The slot that contains the point (beyond the neutral aisle), or kNoSlot.
int slot_at(const Gate& gate, glm::dvec2 point) noexcept;

// Force on the lever with the proxy at this point of free space: the negative gradient of gate_energy. [N]
glm::dvec2 gate_feel(const Gate& gate, glm::dvec2 proxy) noexcept;

// Potential of gate_feel(). It depends only on position, so no closed path supplies energy. [J]
double gate_energy(const Gate& gate, glm::dvec2 proxy) noexcept;

// Largest restoring stiffness anywhere in the gate; the coupling must not be softer. [N/m]
double max_feel_stiffness(const Gate& gate) noexcept;

}  // namespace gearshift::haptics
