// Compiles a layout of straight aisles at any angle, with places on them: selectors, cross gates, staircases.
#pragma once

#include <glm/vec2.hpp>

#include "haptics/gate/gate.h"
#include "haptics/gate/gate_layout.h"

namespace gearshift::haptics {

// As compile_gate(), for a layout that has aisles. Throws FileError with line and reason, for example if aisles only
// touch, if a place lies in no aisle, or if springs round a loop of aisles would drive the lever round for ever.
Gate compile_mechanism(const GateLayout& layout, glm::dvec2 workspace, double radius);

}  // namespace gearshift::haptics
