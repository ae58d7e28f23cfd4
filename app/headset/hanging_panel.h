// The panel as a picture that hangs in the cabin, and a hand that points at it.
#pragma once

#include <optional>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "app/stage/drive_side.h"
#include "engine/scene/view.h"

namespace gearshift {

struct HangingPanel {
  EyePose pose;          // of its middle, in the cabin; it faces along its +Z
  glm::dvec2 size{0.0};  // [m]
};

// Of a picture of that size [px], before the windscreen at the passenger's side: 1.4 m from the driver's eyes, facing
// them, where nothing of the cabin stands nearer, and 1.5 m wide. It hangs still: nothing is locked to the head.
HangingPanel hang_panel(glm::dvec3 driver_eye, DriveSide side, glm::dvec2 picture);

struct PanelHit {
  glm::dvec2 at{0.0};     // [1] of the picture, from its upper left corner
  double distance = 0.0;  // [m] from the hand
};

// Where the ray along the hand's -Z meets the panel's face; none beside it or from behind.
std::optional<PanelHit> point_at(const HangingPanel& panel, const EyePose& hand);

}  // namespace gearshift
