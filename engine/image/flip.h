// The difference that a viewer perceives when flipping between two pictures.
#pragma once

#include <vector>

#include "engine/image/image.h"

namespace gearshift::engine {

struct FlipError {
  double mean = 0.0;        // [1] mean over all pixels; 0: equal, 1: maximally different
  std::vector<double> map;  // [1] error per pixel, rows from the top
};

// The paper's default: a screen that is 3840 pixels and 0.7 m wide, viewed from 0.7 m.
inline constexpr double kFlipPixelsPerDegree = 67.0206;

// Computes LDR-FLIP; ignores alpha. Throws std::invalid_argument if sizes differ. `pixels_per_degree`: pixels per
// degree of visual angle.
FlipError flip(const Image& reference, const Image& test, double pixels_per_degree = kFlipPixelsPerDegree);

}  // namespace gearshift::engine
