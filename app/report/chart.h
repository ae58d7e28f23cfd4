// Axes of a small plot: a box, two ranges, a grid.
#pragma once

#include <string_view>

#include <glm/vec2.hpp>

#include "app/draw/svg.h"

namespace gearshift {

struct Range {
  double from = 0.0, to = 1.0;
};

class Chart {
 public:
  Chart(Svg& svg, const Rect& box, Range x, Range y) : svg_(svg), box_(box), x_(x), y_(y) {}

  glm::dvec2 at(double x, double y) const noexcept;  // on the page
  // Grid lines at every multiple of `step`, and their numbers.
  void x_lines(double step) const;
  void x_grid(double step) const;
  void y_grid(double step) const;
  void x_name(std::string_view words) const;  // below the numbers
  void y_name(std::string_view words) const;  // above the box

 private:
  Svg& svg_;
  Rect box_;
  Range x_, y_;
};

// 1, 2 or 5 times a power of ten: at most `most` of them within `span`.
double grid_step(double span, int most) noexcept;

}  // namespace gearshift
