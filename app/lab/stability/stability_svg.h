// Draws the map of stable stiffness K and damping B.
#pragma once

#include <string>

#include "app/lab/stability/stability.h"

namespace gearshift::lab {

// Returns a complete SVG document. It plots stiffness (logarithmic) against damping: the limit of each hand, the
// passivity limit, the wanted wall, and the area that is stable with every hand.
std::string stability_svg(const StabilityQuestion& question, const StabilityAnswer& answer, const StabilityMap& map);

}  // namespace gearshift::lab
