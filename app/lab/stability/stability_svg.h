// Draws the K-B map.
#pragma once

#include <string>

#include "app/lab/stability/stability.h"

namespace gearshift::lab {

// A complete SVG document: each hand's limit against the wall's damping, the passivity limit, the wanted wall, and the
// area that is stable with every hand. K has a logarithmic scale.
std::string stability_svg(const StabilityQuestion& question, const StabilityAnswer& answer, const StabilityMap& map);

}  // namespace gearshift::lab
