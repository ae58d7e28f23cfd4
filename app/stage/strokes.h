// Lines with a width: the stroke font of gear marks, and the shift pattern on a knob.
#pragma once

#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/image/image.h"
#include "haptics/gate/gate.h"

namespace gearshift {

using Line = std::vector<glm::dvec2>;  // an open line; closed where its ends are equal

struct Stroke {
  Line line;
  double width = 0.0;
  glm::vec3 colour{1.0f};  // linear
};

// Lines of "R", "N", "1" ... "9"; what the font does not know is a box. The sign's centre stands at `centre`, its lines
// are as wide as `width`.
std::vector<Stroke> gear_sign(int gear, glm::dvec2 centre, double height, double width, glm::vec3 colour);

// The pattern of a gate as a knob shows it, in the unit square, y up: aisles in proportion, gears at their ends.
std::vector<Stroke> shift_pattern(const Gate& gate, glm::vec3 colour, glm::vec3 reverse_colour);

// Corners of the triangles of a stroke, three each, counter-clockwise; round ends and corners.
std::vector<glm::dvec2> stroke_triangles(const Stroke& stroke);

// The unit square as a picture, sRGB, row 0 at y = 1; edges as soft as a pixel.
Image draw_strokes(const std::vector<Stroke>& strokes, int side, glm::vec3 ground);

}  // namespace gearshift
