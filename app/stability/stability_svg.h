// The K-B map as a drawing.
#pragma once

#include <string>

#include "app/stability/stability.h"

namespace gearshift {

// A whole SVG document: the limit of each hand over the wall's damping, the passive limit, the wanted wall, and what
// is stable in every hand as an area. K on a logarithmic scale.
std::string stability_svg(const StabilityQuestion& question, const StabilityAnswer& answer, const StabilityMap& map);

}  // namespace gearshift
