// What the mechanism does to a lever that is inside its aisles: centring, mouth bump, detent, lock, buffers.
#pragma once

#include <glm/vec2.hpp>

#include "haptics/gate/gate.h"

namespace gearshift {

// Slot that the point is in (past the neutral aisle), or kNoSlot.
int slot_at(const Gate& gate, glm::dvec2 point) noexcept;

// Force on the lever for a proxy at this point of the free space. [N] The negative gradient of gate_energy.
glm::dvec2 gate_feel(const Gate& gate, glm::dvec2 proxy) noexcept;

// Potential of that force. [J] Position only: no closed path gives energy.
double gate_energy(const Gate& gate, glm::dvec2 proxy) noexcept;

// Largest restoring stiffness anywhere in the gate. [N/m] The coupling must not be softer.
double stiffest_feel(const Gate& gate) noexcept;

}  // namespace gearshift
