#pragma once

#include "app/tour/tour.h"

namespace gearshift {

// What a drive did, on stdout; what was limited, on stderr.
void print_tour(const TourSetup& setup, const TourResult& result);

}  // namespace gearshift
