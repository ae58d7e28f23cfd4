// The parts of a gate that every drawing of one shares. In millimetres of the gate with y down, as SVG has it: forward
// is up.
#pragma once

#include <glm/vec2.hpp>

#include "app/draw/svg.h"
#include "haptics/gate/gate_description.h"

namespace gearshift {

inline constexpr double kWallWidth = 0.7;  // [mm] as drawn
inline constexpr double kStopWidth = 1.1;  // [mm]

constexpr double mm(double metres) {
  return metres * 1e3;
}
glm::dvec2 on_page(glm::dvec2 metres);

Rect gate_plate(const Gate& gate);  // the walls' extent, with a rim
// A line across a slot from wall to wall. depth: [m]
void across_slot(Svg& svg, const Gate& gate, const Slot& slot, double depth, const Pen& pen);

void draw_gate_ground(Svg& svg, const Gate& gate, const GateDescription& description);  // the plate, cut open
void draw_gate_walls(Svg& svg, const GateDescription& description);
void draw_gears(Svg& svg, const Gate& gate);  // where each counts, is released and rests; its name on the rim

}  // namespace gearshift
