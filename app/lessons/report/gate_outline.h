// Parts shared by all drawings of a gate. Page units are millimetres of the gate; y points down as in SVG, so that
// forward is up.
#pragma once

#include <glm/vec2.hpp>

#include "app/base/svg.h"
#include "haptics/gate/gate_description.h"

namespace gearshift::lessons {

inline constexpr double kWallWidth = 0.7;  // [mm] as drawn
inline constexpr double kStopWidth = 1.1;  // [mm]

constexpr double mm(double metres) {
  return metres * 1e3;
}
glm::dvec2 on_page(glm::dvec2 metres);

base::Rect gate_plate(const haptics::Gate& gate);  // bounding box of the walls plus a rim
// Draws a line across a slot from wall to wall, at `depth` [m].
void across_slot(base::Svg& svg, const haptics::Gate& gate, const haptics::Slot& slot, double depth,
                 const base::Pen& pen);

// Draws the plate and the free space on it.
void draw_gate_ground(base::Svg& svg, const haptics::Gate& gate, const haptics::GateDescription& description);
void draw_gate_walls(base::Svg& svg, const haptics::GateDescription& description);
// Draws the depths at which gears engage, release and rest, and the gears' names on the rim.
void draw_gears(base::Svg& svg, const haptics::Gate& gate);

}  // namespace gearshift::lessons
