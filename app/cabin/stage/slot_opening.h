// Computes the opening for a gate in a plate above the lever's pivot.
//
// The gate is defined at the knob. The lever is straight and turns about the yoke's centre. So the point q at which it
// crosses a plane at the height h above the centre is the central projection of the knob: q = h p / p_z, with the
// knob's position p and its height p_z.
#pragma once

#include <glm/vec2.hpp>

#include "app/cabin/stage/polygon.h"
#include "haptics/gate/gate.h"
#include "haptics/joystick/kinematics.h"

namespace gearshift::cabin {

// The projection from gate to plate and its inverse. All values in [m]; x: select, y: shift, height: above the yoke's
// centre.
glm::dvec2 plate_point(const haptics::YokeGeometry& yoke, glm::dvec2 gate_point, double height) noexcept;
glm::dvec2 gate_point(const haptics::YokeGeometry& yoke, glm::dvec2 plate_point, double height) noexcept;

struct SlotOpening {
  Loop loop;                // outline of the opening, counter-clockwise
  Loop face;                // the edge on the plate's face: `loop` widened by the bevel, same number of points
  double rod_radius = 0.0;  // [m] largest lever radius that leaves metal between the slots
  double widened = 0.0;     // [m] added on all sides of the lever's path: space for the leaning rod
  double bevel = 0.0;       // [m] width of the bevel
};

// The region that the lever's axis sweeps on the plate, widened so that the rod fits.
SlotOpening slot_opening(const haptics::Gate& gate, const haptics::YokeGeometry& yoke, double height);

}  // namespace gearshift::cabin
