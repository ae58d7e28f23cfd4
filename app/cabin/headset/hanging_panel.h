// Places the panel as an image in the cabin, and finds the point on it at which a controller points.
#pragma once

#include <optional>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "app/cabin/stage/drive_side.h"
#include "engine/scene/view.h"

namespace gearshift::cabin {

struct HangingPanel {
  engine::EyePose pose;            // pose of the panel's centre in cabin axes; the panel faces along the pose's +Z
  glm::dvec2 size{0.0};            // [m] width and height
  glm::dvec2 low{0.0}, high{1.0};  // [1] corners of the shown part of the image, as fractions of the image
};

// The panels of the next two functions hang 1.4 m from the driver's eyes and face them, with no part of the cabin in
// between. They are fixed in the cabin, not locked to the head. `picture`: size of the panel's image [px].

// The whole panel, 1.5 m wide, in front of the windscreen on the passenger's side.
HangingPanel hang_panel(glm::dvec3 driver_eye, DriveSide side, glm::dvec2 picture);
// Shows only the part of the image with the lesson card, 0.75 m wide, beside the driver's view of the road; the card's
// lower edge is just above the dashboard. `low`, `high`: corners of that part, as in HangingPanel.
HangingPanel hang_card(glm::dvec3 driver_eye, DriveSide side, glm::dvec2 picture, glm::dvec2 low, glm::dvec2 high);

struct PanelHit {
  glm::dvec2 at{0.0};     // [1] position in the whole image, from its upper left corner
  double distance = 0.0;  // [m] distance from the controller
};

// Returns the point where the ray along the controller's -Z hits the front of the panel; empty if the ray misses the
// panel or comes from behind it.
std::optional<PanelHit> point_at(const HangingPanel& panel, const engine::EyePose& hand);

}  // namespace gearshift::cabin
