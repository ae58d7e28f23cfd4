// How different a viewer sees two pictures who flips between them.
#pragma once

#include <vector>

#include "engine/image/image.h"

namespace gearshift {

struct FlipError {
  double mean = 0.0;        // [1] over the pixels: 0 equal, 1 as different as can be
  std::vector<double> map;  // [1] of every pixel, rows from the top
};

// A screen of 3840 pixels over 0.7 m, seen from 0.7 m: the paper's default.
inline constexpr double kFlipPixelsPerDegree = 67.0206;

// LDR-FLIP. Alpha is not compared. Same size, or std::invalid_argument. pixels_per_degree [px/deg] of the viewer's eye
FlipError flip(const Image& reference, const Image& test, double pixels_per_degree = kFlipPixelsPerDegree);

}  // namespace gearshift
