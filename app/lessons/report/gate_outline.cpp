#include "app/lessons/report/gate_outline.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <glm/common.hpp>

#include "app/base/colours.h"

namespace gearshift::lessons {
namespace {

constexpr double kPlateRim = 9.0;  // [mm] width of the plate beyond the outermost wall

// Page coordinates of a point in a slot: x across the slot, depth along the slot. [m]
glm::dvec2 in_slot(const haptics::Slot& slot, double x, double depth) {
  return on_page({x, static_cast<int>(slot.side) * depth});
}

base::Rect mechanism_box(const haptics::Gate& gate) {
  glm::dvec2 low{HUGE_VAL}, high{-HUGE_VAL};
  for (const haptics::Aisle& aisle : haptics::aisles(gate)) {
    low = glm::min(low, glm::min(aisle.from, aisle.to) - aisle.half_width);
    high = glm::max(high, glm::max(aisle.from, aisle.to) + aisle.half_width);
  }
  return {mm(low.x), -mm(high.y), mm(high.x - low.x), mm(high.y - low.y)};
}

// Bounding box of the gate's walls on the page.
base::Rect gate_box(const haptics::Gate& gate) {
  if (haptics::is_mechanism(gate)) return mechanism_box(gate);
  double forward = gate.half_aisle;
  double back = gate.half_aisle;
  for (const haptics::Slot& slot : haptics::slots(gate)) {
    double& reach = slot.side == haptics::Side::forward ? forward : back;
    reach = std::max(reach, slot.end);
  }
  return {mm(gate.select_min), -mm(forward), mm(gate.select_max - gate.select_min), mm(forward + back)};
}

void draw_free_space(base::Svg& svg, const haptics::GateDescription& list) {
  for (const haptics::AisleInfo& a : list.aisles) {
    if (!a.outline.empty()) {
      std::vector<glm::dvec2> points;
      for (const glm::dvec2 p : a.outline) points.push_back(on_page(p));
      svg.polygon(points, base::kFreeColour);
      continue;
    }
    svg.rect({mm(a.min.x), -mm(a.max.y), mm(a.max.x - a.min.x), mm(a.max.y - a.min.y)}, base::kFreeColour);
  }
  for (const haptics::WallInfo& wall : list.walls) {
    if (wall.role != haptics::WallRole::chamfer) continue;  // a chamfer adds a triangle of free space at the corner
    svg.polygon({on_page(wall.from), on_page(wall.to), on_page({wall.to.x, wall.from.y})}, base::kFreeColour);
  }
}

base::Pen wall_pen(haptics::WallRole role) {
  switch (role) {
    case haptics::WallRole::end_stop:
      return {base::kInk, kStopWidth};
    case haptics::WallRole::closed_side:
      return {base::kClosedColour, kStopWidth};
    case haptics::WallRole::aisle:
    case haptics::WallRole::chamfer:
      return {base::kInk, kWallWidth};
  }
  return {};
}

// Where a place's name is written: beside it, outside the aisles.
struct PlaceName {
  glm::dvec2 at{0.0};
  const char* anchor = "middle";
};

PlaceName place_name(const haptics::Gate& gate, const haptics::Slot& place) {
  double half_width = 0.0;
  for (int i = 0; i < gate.aisle_count; ++i)
    if ((place.aisles >> i & 1u) != 0)
      half_width = std::max(half_width, gate.aisle[static_cast<std::size_t>(i)].half_width);
  constexpr double kSide = 0.7071;
  const PlaceName ways[] = {{{0.0, 1.0}, "middle"},    {{0.0, -1.0}, "middle"},   {{1.0, 0.0}, "start"},
                            {{-1.0, 0.0}, "end"},      {{kSide, kSide}, "start"}, {{-kSide, kSide}, "end"},
                            {{kSide, -kSide}, "start"}};
  for (const PlaceName& way : ways) {
    const PlaceName name{place.at + (half_width + 4e-3) * way.at, way.anchor};
    if (!haptics::in_free_space(gate, name.at, 2e-3)) return name;
  }
  return {place.at, "middle"};
}

void draw_places(base::Svg& svg, const haptics::Gate& gate) {
  for (const haptics::Slot& place : haptics::slots(gate)) {
    const glm::dvec2 at = on_page(place.at);
    svg.ring(at, mm(place.end - place.engage_depth), {base::kGearColour, 0.25});
    svg.dot(at, 0.7, base::kGearColour);
    const PlaceName name = place_name(gate, place);
    svg.text(on_page(name.at) + glm::dvec2(0.0, 1.5), {4.2, base::kGearColour, name.anchor, true},
             haptics::gear_label(gate, place.gear));
  }
}

}  // namespace

glm::dvec2 on_page(glm::dvec2 metres) {
  return {mm(metres.x), -mm(metres.y)};
}

void across_slot(base::Svg& svg, const haptics::Gate& gate, const haptics::Slot& slot, double depth,
                 const base::Pen& pen) {
  const haptics::Column& column = haptics::column_of(gate, slot.column);
  const double left = column.center - column.half_width;
  const double right = column.center + column.half_width;
  svg.line(in_slot(slot, left, depth), in_slot(slot, right, depth), pen);
}

base::Rect gate_plate(const haptics::Gate& gate) {
  const base::Rect walls = gate_box(gate);
  return {walls.x - kPlateRim, walls.y - kPlateRim, walls.width + 2.0 * kPlateRim, walls.height + 2.0 * kPlateRim};
}

void draw_gate_ground(base::Svg& svg, const haptics::Gate& gate, const haptics::GateDescription& description) {
  svg.rect(gate_plate(gate), base::kPlateColour, 4.0);
  draw_free_space(svg, description);
}

// Draws closed sides last, so that they stay visible where they overlap a slot's wall.
void draw_gate_walls(base::Svg& svg, const haptics::GateDescription& description) {
  for (const bool closed : {false, true}) {
    for (const haptics::WallInfo& wall : description.walls) {
      if ((wall.role == haptics::WallRole::closed_side) != closed) continue;
      svg.line(on_page(wall.from), on_page(wall.to), wall_pen(wall.role));
    }
  }
}

void draw_gears(base::Svg& svg, const haptics::Gate& gate) {
  if (haptics::is_mechanism(gate)) return draw_places(svg, gate);
  for (const haptics::Slot& slot : haptics::slots(gate)) {
    const double x = haptics::column_of(gate, slot.column).center;
    across_slot(svg, gate, slot, slot.engage_depth, {base::kGearColour, 0.25});
    across_slot(svg, gate, slot, slot.release_depth, {base::kGearColour, 0.25, base::kShortDash});
    svg.dot(in_slot(slot, x, slot.rest), 0.7, base::kGearColour);
    // Digits are about 0.73 times the font size high. An offset of about half this height centres them on the rim.
    const glm::dvec2 label = in_slot(slot, x, slot.end + 0.5e-3 * kPlateRim) + glm::dvec2(0.0, 1.95);
    svg.text(label, {5.4, base::kGearColour, "middle", true}, haptics::gear_label(gate, slot.gear));
  }
}

}  // namespace gearshift::lessons
