// Decides whether the mouse belongs to the panel or to the cabin.
#pragma once

#include <glm/vec2.hpp>

namespace gearshift::ui {

// See Panel::covers().
bool panel_covers(glm::dvec2 mouse);

}  // namespace gearshift::ui
