#include "app/cabin/stage/gate_plate.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace gearshift::cabin {
namespace {

constexpr glm::dvec2 kPlinthHalf{0.0640, 0.0680};          // [m] half size of the plinth's foot and the boot's frame
constexpr glm::dvec2 kMinHalf{0.034, 0.040};               // [m] minimum half size of the plate
constexpr double kSideMargin = 0.009, kEndMargin = 0.006;  // [m] width of metal outside openings and labels
constexpr double kLampRoom = 0.010;                        // [m] space for the lamp, in front of the labels
constexpr double kCorner = 0.010;                          // [m] radius of the plate's corners
constexpr int kCornerSteps = 6;
constexpr double kBevel = 0.0004;     // [m] bevel of the outer edge
constexpr double kLip = 0.0022;       // [m] height of the metal edge above the plinth
constexpr double kInkAbove = 0.0001;  // [m] height of the labels' enamel above the face
constexpr double kSign = 0.0090;      // [m] maximum height of a label
constexpr double kSignGap = 0.0025;   // [m] distance between opening and label
constexpr double kSignWidth = 0.6;    // width of a label relative to its height
constexpr glm::vec3 kInk{0.015f}, kReverseInk{0.42f, 0.012f, 0.010f}, kBright{1.0f}, kDeep{0.22f};

Loop scaled(const Loop& loop, double factor) {
  Loop copy = loop;
  for (glm::dvec2& p : copy) p *= factor;
  return copy;
}

// Makes the plate's face and bevelled edges, the plinth, and the walls of the opening. The walls converge towards the
// pivot, so that they are parallel to the leaning lever.
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

  add_wall(plate.metal, {face, kPlateHeight, bright}, {rim, kPlateHeight - kBevel, bright}, WallFace::from_right);
  add_wall(plate.metal, {rim, kPlateHeight - kBevel, bright}, {rim, kPlateHeight - kLip, bright}, WallFace::from_right);
  add_wall(plate.plinth, {rim, kPlateHeight - kLip, bright}, {foot, kPlinthHeight, bright}, WallFace::from_right);
  const Loop throat = scaled(path, edge / kPlateHeight), bottom = scaled(path, floor / kPlateHeight);
  add_wall(plate.metal, {hole, kPlateHeight, bright}, {throat, edge, bright}, WallFace::from_left);
  add_wall(plate.metal, {throat, edge, bright}, {bottom, floor, deep}, WallFace::from_left);
}

// Smallest distance [m] between neighbouring columns, measured at the knob.
double label_room(const haptics::Gate& gate) {
  double room = 1.0;
  for (int i = 0; i + 1 < gate.column_count; ++i) {
    room = std::min(room, haptics::column_of(gate, i + 1).center - haptics::column_of(gate, i).center);
  }
  return room;
}

// The label of a place in a gate of aisles, as written in the file.
void add_place_label(GatePlate& plate, const haptics::Gate& gate, const haptics::YokeGeometry& yoke,
                     const haptics::Slot& place) {
  constexpr double kMaxLength = 0.016;  // [m]
  const std::string label = haptics::gear_label(gate, place.gear);
  const double height = std::min(0.8 * kSign, kMaxLength / text_length(label));
  const double enlarged = yoke.radius / kPlateHeight;  // what is on the plate, seen at the knob
  const glm::dvec2 size = enlarged * height * glm::dvec2(text_length(label), 1.0);
  const glm::dvec2 centre = plate_point(
      yoke, label_place(gate, place, size, enlarged * (plate.opening.widened + 0.6 * kSignGap)), kPlateHeight);
  plate.labels.push_back({place.gear, centre, std::max(height, height * text_length(label))});
  const glm::vec3 colour = place.gear == haptics::kReverseGear ? kReverseInk : kInk;
  for (const Stroke& stroke : text_strokes(label, centre, height, 0.16 * height, colour))
    add_flat(plate.ink, stroke_triangles(stroke), kPlateHeight + kInkAbove, linear_rgba(colour));
}

void add_label(GatePlate& plate, const haptics::Gate& gate, const haptics::YokeGeometry& yoke,
               const haptics::Slot& slot) {
  if (haptics::is_mechanism(gate)) return add_place_label(plate, gate, yoke, slot);
  const double side = static_cast<int>(slot.side);
  const double x = haptics::column_of(gate, slot.column).center;
  const glm::dvec2 end = plate_point(yoke, {x, side * slot.end}, kPlateHeight);
  const double height = std::min(kSign, label_room(gate) * kPlateHeight / yoke.radius / kSignWidth * 0.8);
  const glm::dvec2 centre = end + glm::dvec2(0.0, side * (plate.opening.widened + kSignGap + 0.5 * height));
  plate.labels.push_back({slot.gear, centre, height});
  const glm::vec3 colour = slot.gear == haptics::kReverseGear ? kReverseInk : kInk;
  for (const Stroke& stroke : gear_label(slot.gear, centre, height, 0.16 * height, colour)) {
    add_flat(plate.ink, stroke_triangles(stroke), kPlateHeight + kInkAbove, linear_rgba(colour));
  }
}

// Computes the size of the plate: as small as openings and labels allow, symmetric about the pivot, with space for the
// lamp in front of the labels.
void size_plate(GatePlate& plate) {
  plate.half = kMinHalf;
  double foremost = 0.0;
  for (const glm::dvec2 p : plate.opening.face) {
    plate.half = glm::max(plate.half, glm::abs(p) + glm::dvec2(kSideMargin, kEndMargin));
    foremost = std::max(foremost, p.y);
  }
  for (const PlateLabel& label : plate.labels) {
    const double end = std::abs(label.centre.y) + 0.5 * label.height;
    plate.half.x = std::max(plate.half.x, std::abs(label.centre.x) + 0.5 * label.height + kEndMargin);
    plate.half.y = std::max(plate.half.y, end + kEndMargin);
    if (label.centre.y > 0.0) foremost = std::max(foremost, end);
  }
  plate.half.y = std::max(plate.half.y, foremost + kLampRoom);
  plate.lamp = {0.0, 0.5 * (foremost + plate.half.y)};
}

}  // namespace

GatePlate make_gate_plate(const haptics::Gate& gate, const haptics::YokeGeometry& yoke) {
  GatePlate plate;
  plate.opening = slot_opening(gate, yoke, kPlateHeight);
  for (const haptics::Slot& slot : haptics::slots(gate)) add_label(plate, gate, yoke, slot);
  size_plate(plate);
  make_metal(plate);
  return plate;
}

}  // namespace gearshift::cabin
