// The open gate: a plate with the slots of the loaded gate and a gear label at the end of each.
#pragma once

#include <vector>

#include "app/cabin/stage/mesh_builder.h"
#include "app/cabin/stage/slot_opening.h"
#include "app/cabin/stage/strokes.h"

namespace gearshift::cabin {

// The plate is on a plinth, half way from the lever's pivot to the knob. At the lower height of the boot's frame the
// slots would be so close together (see slot_opening.h) that only a needle-thin lever would leave metal between them.
inline constexpr double kPlateHeight = 0.062;     // [m] height of the plate's face above the pivot
inline constexpr double kPlinthHeight = 0.030;    // [m] height of the plinth's foot (the console) above the pivot
inline constexpr double kPlateThickness = 0.004;  // [m]

struct PlateLabel {
  int gear = haptics::kNeutralGear;
  glm::dvec2 centre{0.0};  // [m] position on the plate
  double height = 0.0;     // [m]
};

struct GatePlate {
  SlotOpening opening;
  std::vector<PlateLabel> labels;
  glm::dvec2 half{0.0};  // [m] half the size of the plate, which depends on the gate
  glm::dvec2 lamp{0.0};  // [m] position for a lamp with 4 mm radius, in front of the labels
  MeshData metal;        // the lever's pivot is the origin of all three meshes; x right, y up, z back
  MeshData plinth;
  MeshData ink;
};

// Throws std::runtime_error if the gate's slots do not fit on the plate. All gates that the paper's joystick can reach
// fit.
GatePlate make_gate_plate(const haptics::Gate& gate, const haptics::YokeGeometry& yoke);

}  // namespace gearshift::cabin
