#include "app/draw/gate_outline.h"

#include <algorithm>

#include "app/draw/gate_colours.h"

namespace gearshift {
namespace {

constexpr double kPlateRim = 9.0;  // [mm] of the plate beyond the outermost wall

// A point of a slot's branch: x across, depth along. [m]
glm::dvec2 in_slot(const Slot& slot, double x, double depth) {
  return on_page({x, static_cast<int>(slot.side) * depth});
}

// Extent of the gate's walls on the page.
Rect gate_box(const Gate& gate) {
  double forward = gate.half_aisle;
  double back = gate.half_aisle;
  for (const Slot& slot : slots(gate)) {
    double& reach = slot.side == Side::forward ? forward : back;
    reach = std::max(reach, slot.end);
  }
  return {mm(gate.select_min), -mm(forward), mm(gate.select_max - gate.select_min), mm(forward + back)};
}

void draw_free_space(Svg& svg, const GateDescription& list) {
  for (const AisleInfo& a : list.aisles) {
    svg.rect({mm(a.min.x), -mm(a.max.y), mm(a.max.x - a.min.x), mm(a.max.y - a.min.y)}, kFreeColour);
  }
  for (const WallInfo& wall : list.walls) {
    if (wall.role != WallRole::chamfer) continue;  // the triangle that the corner opens
    svg.polygon({on_page(wall.from), on_page(wall.to), on_page({wall.to.x, wall.from.y})}, kFreeColour);
  }
}

Pen wall_pen(WallRole role) {
  switch (role) {
    case WallRole::end_stop:
      return {kInk, kStopWidth};
    case WallRole::closed_side:
      return {kClosedColour, kStopWidth};
    case WallRole::aisle:
    case WallRole::chamfer:
      return {kInk, kWallWidth};
  }
  return {};
}

}  // namespace

glm::dvec2 on_page(glm::dvec2 metres) {
  return {mm(metres.x), -mm(metres.y)};
}

void across_slot(Svg& svg, const Gate& gate, const Slot& slot, double depth, const Pen& pen) {
  const Column& column = column_of(gate, slot.column);
  const double left = column.center - column.half_width;
  const double right = column.center + column.half_width;
  svg.line(in_slot(slot, left, depth), in_slot(slot, right, depth), pen);
}

Rect gate_plate(const Gate& gate) {
  const Rect walls = gate_box(gate);
  return {walls.x - kPlateRim, walls.y - kPlateRim, walls.width + 2.0 * kPlateRim, walls.height + 2.0 * kPlateRim};
}

void draw_gate_ground(Svg& svg, const Gate& gate, const GateDescription& description) {
  svg.rect(gate_plate(gate), kPlateColour, 4.0);
  draw_free_space(svg, description);
}

// Closed sides last: where one meets a slot's wall it is the closed side that must be seen.
void draw_gate_walls(Svg& svg, const GateDescription& description) {
  for (const bool closed : {false, true}) {
    for (const WallInfo& wall : description.walls) {
      if ((wall.role == WallRole::closed_side) != closed) continue;
      svg.line(on_page(wall.from), on_page(wall.to), wall_pen(wall.role));
    }
  }
}

void draw_gears(Svg& svg, const Gate& gate) {
  for (const Slot& slot : slots(gate)) {
    const double x = column_of(gate, slot.column).center;
    across_slot(svg, gate, slot, slot.engage_depth, {kGearColour, 0.25});
    across_slot(svg, gate, slot, slot.release_depth, {kGearColour, 0.25, kShortDash});
    svg.dot(in_slot(slot, x, slot.rest), 0.7, kGearColour);
    // Digits are about 0.73 of their size high: half of that brings them to the middle of the rim.
    const glm::dvec2 label = in_slot(slot, x, slot.end + 0.5e-3 * kPlateRim) + glm::dvec2(0.0, 1.95);
    svg.text(label, {5.4, kGearColour, "middle", true}, gear_name(slot.gear));
  }
}

}  // namespace gearshift
