// The opening that a gate needs in a plate above the lever's pivot.
//
// The gate is written at the knob. The lever is straight and turns about the yoke's centre, so that it passes a plane
// at height h above the centre where the central projection of the knob lies: q = h p / p_z, p_z the knob's height.
#pragma once

#include <glm/vec2.hpp>

#include "app/stage/polygon.h"
#include "haptics/gate/gate.h"
#include "haptics/joystick/kinematics.h"

namespace gearshift {

// Both ways of the projection. [m]; x = select, y = shift, height above the yoke's centre.
glm::dvec2 plate_point(const YokeGeometry& yoke, glm::dvec2 gate_point, double height) noexcept;
glm::dvec2 gate_point(const YokeGeometry& yoke, glm::dvec2 plate_point, double height) noexcept;

struct SlotOpening {
  Loop loop;                // counter-clockwise about what is cut out
  Loop face;                // the same, wider by the bevel: its edge on the plate's face, point by point
  double rod_radius = 0.0;  // [m] as thick as the lever may be and leave metal between the slots
  double widened = 0.0;     // [m] of the path on all sides: the ellipse that a leaning rod cuts the plane in fits
  double bevel = 0.0;       // [m]
};

// The region that the lever's axis sweeps, widened by the rod.
SlotOpening slot_opening(const Gate& gate, const YokeGeometry& yoke, double height);

}  // namespace gearshift
