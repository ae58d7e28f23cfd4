// The open gate: a plate with the slots of the loaded gate and the gear labels beside them.
#pragma once

#include <vector>

#include "app/cabin/stage/mesh_builder.h"
#include "app/cabin/stage/slot_opening.h"
#include "app/cabin/stage/strokes.h"

namespace gearshift::cabin {

// [m] The plate is on a plinth, half way from the lever's pivot to the knob. Lower, at the boot's frame, the central
// projection would leave no metal between the slots unless the lever were as thin as a needle.
inline constexpr double kPlateHeight = 0.062;   // the plate's face above the pivot
inline constexpr double kPlinthHeight = 0.030;  // the plinth's foot (the console) above the pivot
inline constexpr double kPlateThickness = 0.004;

struct PlateLabel {
  int gear = haptics::kNeutralGear;
  glm::dvec2 centre{0.0};  // [m] on the plate
  double height = 0.0;     // [m]
};

struct GatePlate {
  SlotOpening opening;
  std::vector<PlateLabel> labels;
  glm::dvec2 half{0.0};  // [m] half size of the plate, which depends on the gate
  glm::dvec2 lamp{0.0};  // [m] place for a lamp of 4 mm radius, ahead of the labels
  MeshData metal;        // all three meshes: origin at the lever's pivot; x right, y up, z back
  MeshData plinth;
  MeshData ink;
};

// Throws std::runtime_error if the gate's slots do not fit the plate. All gates that fit the paper's joystick do.
GatePlate make_gate_plate(const haptics::Gate& gate, const haptics::YokeGeometry& yoke);

}  // namespace gearshift::cabin
