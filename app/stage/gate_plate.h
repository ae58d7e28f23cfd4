// The open gate: a plate with the slots of the loaded gate, its gears beside them.
#pragma once

#include <vector>

#include "app/stage/patch.h"
#include "app/stage/slot_opening.h"
#include "app/stage/strokes.h"

namespace gearshift {

// [m] The plate stands on a plinth, half way from the lever's pivot to the knob. Lower, where the cabin's frame for the
// boot lies, the central projection leaves no metal between the slots for a lever that is thicker than a needle.
inline constexpr double kPlateHeight = 0.062;   // of its face above the pivot
inline constexpr double kPlinthHeight = 0.030;  // of its foot above the pivot: the console
inline constexpr double kPlateThickness = 0.004;

struct GearMark {
  int gear = kNeutralGear;
  glm::dvec2 centre{0.0};  // [m] on the plate
  double height = 0.0;     // [m] of the sign
};

struct GatePlate {
  SlotOpening opening;
  std::vector<GearMark> marks;
  glm::dvec2 half{0.0};  // [m] of the plate's outline: as large as its gate asks for
  glm::dvec2 lamp{0.0};  // [m] room for a lamp of 4 mm radius, ahead of the signs
  Patch metal;           // origin at the lever's pivot; x right, y up, z back
  Patch plinth;
  Patch ink;
};

// Throws std::runtime_error where the gate's slots do not fit the plate; none that fits the paper's joystick does that.
GatePlate make_gate_plate(const Gate& gate, const YokeGeometry& yoke);

}  // namespace gearshift
