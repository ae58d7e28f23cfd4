#pragma once

#include "app/lab/tour/tour.h"

namespace gearshift::verbs {

// Prints the results of a tour (a shift into every gear) to stdout. Prints problems and limited parameters to stderr.
void print_tour(const lab::TourSetup& setup, const lab::TourResult& result);

// Prints the same as JSON.
void print_tour_json(const lab::TourSetup& setup, const lab::TourResult& result);

}  // namespace gearshift::verbs
