// Strokes, i.e. lines with a width, for the font of gear labels and dials and for the shift pattern on the knob.
#pragma once

#include <string_view>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/image/image.h"
#include "haptics/gate/gate.h"

namespace gearshift::cabin {

using Line = std::vector<glm::dvec2>;  // a polyline; closed if its first and last point are equal

struct Stroke {
  Line line;
  double width = 0.0;
  glm::vec3 colour{1.0f};  // linear
};

// Strokes of a text of digits, capital letters, "+", "-", "/", " " and the small letters of "km/h", "mph" and "min x".
// Other small letters are small capitals. `height` is that of a digit; any other character is a box.
std::vector<Stroke> text_strokes(std::string_view text, glm::dvec2 centre, double height, double width,
                                 glm::vec3 colour);

// Width of a text relative to the height of its digits.
double text_length(std::string_view text) noexcept;

// Strokes of the label "R", "N" or "1" to "9", centred at `centre`. `width` is the line width. The label of an unknown
// gear is a box.
std::vector<Stroke> gear_label(int gear, glm::dvec2 centre, double height, double width, glm::vec3 colour);

// Where a place's label is, on the metal beside it: the centre of a label of this size [m], at the distance `gap` from
// all aisles if there is room. For gates of aisles.
glm::dvec2 label_place(const haptics::Gate& gate, const haptics::Slot& place, glm::dvec2 size, double gap);

// The gate's shift pattern as printed on a knob, in the unit square with y up. The distances between columns are to
// scale. All slots have the same length, with the gear labels at their ends. A gate of aisles is to scale.
std::vector<Stroke> shift_pattern(const haptics::Gate& gate, glm::vec3 colour, glm::vec3 reverse_colour);

// Fraction [1] of a square of side `pixel` around p that the stroke covers, from the distance to its centre line.
double stroke_coverage(const Stroke& stroke, glm::dvec2 p, double pixel) noexcept;

// Returns the triangles of a stroke with rounded ends and corners; three points per triangle, counter-clockwise.
std::vector<glm::dvec2> stroke_triangles(const Stroke& stroke);

// Draws strokes in the unit square into an sRGB image whose row 0 is at y = 1; edges are antialiased over one pixel.
engine::Image draw_strokes(const std::vector<Stroke>& strokes, int side, glm::vec3 ground);

}  // namespace gearshift::cabin
