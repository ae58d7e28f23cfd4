// The panel as a picture that hangs in the cabin, and a hand that points at it.
#pragma once

#include <optional>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "app/stage/drive_side.h"
#include "engine/scene/view.h"

namespace gearshift {

struct HangingPanel {
  EyePose pose;                    // of its middle, in the cabin; it faces along its +Z
  glm::dvec2 size{0.0};            // [m]
  glm::dvec2 low{0.0}, high{1.0};  // [1] the part of the picture that is shown
};

// 1.4 m from the driver's eyes, facing them, where nothing of the cabin stands nearer. It hangs still: nothing is locked to
// the head. picture: its size [px].
// All of it, 1.5 m wide, before the windscreen at the passenger's side.
HangingPanel hang_panel(glm::dvec3 driver_eye, DriveSide side, glm::dvec2 picture);
// What the panel leaves to the cabin, where a learner's card lies, 0.75 m wide: beside the way ahead, its lower edge just
// above the dashboard.
HangingPanel hang_card(glm::dvec3 driver_eye, DriveSide side, glm::dvec2 picture, glm::dvec2 low, glm::dvec2 high);

struct PanelHit {
  glm::dvec2 at{0.0};     // [1] of the whole picture, from its upper left corner
  double distance = 0.0;  // [m] from the hand
};

// Where the ray along the hand's -Z meets the panel's face; none beside it or from behind.
std::optional<PanelHit> point_at(const HangingPanel& panel, const EyePose& hand);

}  // namespace gearshift
