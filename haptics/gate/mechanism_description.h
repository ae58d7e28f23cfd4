// Describes a mechanism of aisles; see gate_description.h.
#pragma once

#include "haptics/gate/gate_description.h"

namespace gearshift::haptics {

// As describe_gate(). The sides of an aisle between two junctions are a wall pair; the rest of a side, opposite an
// aisle that ends at this one, is the closed side of a junction. Walls follow the outline of all aisles together.
GateDescription describe_mechanism(const Gate& gate);

}  // namespace gearshift::haptics
