// The mouse belongs to the panel where the panel is.
#pragma once

#include <glm/vec2.hpp>

namespace gearshift {

// See Panel::covers().
bool panel_covers(glm::dvec2 mouse);

}  // namespace gearshift
