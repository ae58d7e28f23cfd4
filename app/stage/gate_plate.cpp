#include "app/stage/gate_plate.h"

#include <algorithm>
#include <cmath>
#include <span>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace gearshift {
namespace {

constexpr glm::dvec2 kPlinthHalf{0.0640, 0.0680};          // [m] of its foot, as the cabin's frame for the boot
constexpr glm::dvec2 kSmallest{0.034, 0.040};              // [m] half a plate
constexpr double kSideMargin = 0.009, kEndMargin = 0.006;  // [m] beyond openings and signs
constexpr double kLampRoom = 0.010;                        // [m] ahead of the signs
constexpr double kCorner = 0.010;                          // [m]
constexpr int kCornerSteps = 6;
constexpr double kBevel = 0.0004;     // [m] of the outer edge
constexpr double kLip = 0.0022;       // [m] of metal above the plinth
constexpr double kInkAbove = 0.0001;  // [m] enamel stands a little out
constexpr double kSign = 0.0090;      // [m] tallest sign
constexpr double kSignGap = 0.0025;   // [m] between opening and sign
constexpr double kSignWidth = 0.6;    // of its height, at least what a sign needs
constexpr glm::vec3 kInk{0.015f}, kReverseInk{0.42f, 0.012f, 0.010f}, kBright{1.0f}, kDeep{0.22f};

Loop scaled(const Loop& loop, double factor) {
  Loop copy = loop;
  for (glm::dvec2& p : copy) p *= factor;
  return copy;
}

// The face, its bevelled edges, the plinth, and the walls of the opening. The walls lead to the pivot: so they follow
// the leaning lever all the way down.
void make_metal(GatePlate& plate) {
  const Loop& path = plate.opening.loop;
  const double edge = kPlateHeight - plate.opening.bevel, floor = kPlateHeight - kPlateThickness;
  const Loop& hole = plate.opening.face;
  const Loop face = rounded_rectangle(plate.half - kBevel, kCorner - kBevel, kCornerSteps);
  const Loop rim = rounded_rectangle(plate.half, kCorner, kCornerSteps);
  const Loop foot = rounded_rectangle(kPlinthHalf, kCorner, kCornerSteps);
  const std::uint32_t bright = linear_rgba(kBright), deep = linear_rgba(kDeep);

  const Loop clockwise(hole.rbegin(), hole.rend());
  Loop points = face;
  points.insert(points.end(), clockwise.begin(), clockwise.end());
  std::vector<glm::dvec2> corners;
  for (const std::uint32_t index : triangulate(face, clockwise)) corners.push_back(points[index]);
  add_flat(plate.metal, corners, kPlateHeight, bright);

  add_wall(plate.metal, {face, kPlateHeight, bright}, {rim, kPlateHeight - kBevel, bright}, Seen::from_right);
  add_wall(plate.metal, {rim, kPlateHeight - kBevel, bright}, {rim, kPlateHeight - kLip, bright}, Seen::from_right);
  add_wall(plate.plinth, {rim, kPlateHeight - kLip, bright}, {foot, kPlinthHeight, bright}, Seen::from_right);
  const Loop throat = scaled(path, edge / kPlateHeight), bottom = scaled(path, floor / kPlateHeight);
  add_wall(plate.metal, {hole, kPlateHeight, bright}, {throat, edge, bright}, Seen::from_left);
  add_wall(plate.metal, {throat, edge, bright}, {bottom, floor, deep}, Seen::from_left);
}

// Least distance of two columns with slots on the same side, on the plate at their ends. [m]
double sign_room(const Gate& gate) {
  double room = 1.0;
  for (int i = 0; i + 1 < gate.column_count; ++i) {
    room = std::min(room, column_of(gate, i + 1).center - column_of(gate, i).center);
  }
  return room;
}

void add_mark(GatePlate& plate, const Gate& gate, const YokeGeometry& yoke, const Slot& slot) {
  const double side = static_cast<int>(slot.side);
  const double x = column_of(gate, slot.column).center;
  const glm::dvec2 end = plate_point(yoke, {x, side * slot.end}, kPlateHeight);
  const double height = std::min(kSign, sign_room(gate) * kPlateHeight / yoke.radius / kSignWidth * 0.8);
  const glm::dvec2 centre = end + glm::dvec2(0.0, side * (plate.opening.widened + kSignGap + 0.5 * height));
  plate.marks.push_back({slot.gear, centre, height});
  const glm::vec3 colour = slot.gear == kReverseGear ? kReverseInk : kInk;
  for (const Stroke& stroke : gear_sign(slot.gear, centre, height, 0.16 * height, colour)) {
    add_flat(plate.ink, stroke_triangles(stroke), kPlateHeight + kInkAbove, linear_rgba(colour));
  }
}

// As small as openings and signs allow, symmetrical about the pivot; the lamp's room lies in front.
void measure(GatePlate& plate) {
  plate.half = kSmallest;
  double foremost = 0.0;
  for (const glm::dvec2 p : plate.opening.face) {
    plate.half = glm::max(plate.half, glm::abs(p) + glm::dvec2(kSideMargin, kEndMargin));
    foremost = std::max(foremost, p.y);
  }
  for (const GearMark& mark : plate.marks) {
    const double end = std::abs(mark.centre.y) + 0.5 * mark.height;
    plate.half.x = std::max(plate.half.x, std::abs(mark.centre.x) + 0.5 * mark.height + kEndMargin);
    plate.half.y = std::max(plate.half.y, end + kEndMargin);
    if (mark.centre.y > 0.0) foremost = std::max(foremost, end);
  }
  plate.half.y = std::max(plate.half.y, foremost + kLampRoom);
  plate.lamp = {0.0, 0.5 * (foremost + plate.half.y)};
}

}  // namespace

GatePlate make_gate_plate(const Gate& gate, const YokeGeometry& yoke) {
  GatePlate plate;
  plate.opening = slot_opening(gate, yoke, kPlateHeight);
  for (const Slot& slot : slots(gate)) add_mark(plate, gate, yoke, slot);
  measure(plate);
  make_metal(plate);
  return plate;
}

}  // namespace gearshift
