// Axes of a small plot: a box, two ranges and a grid.
#pragma once

#include <string_view>

#include <glm/vec2.hpp>

#include "app/base/svg.h"

namespace gearshift::lessons {

struct ChartRange {
  double from = 0.0, to = 1.0;
};

class Chart {
 public:
  Chart(base::Svg& svg, const base::Rect& box, ChartRange x, ChartRange y) : svg_(svg), box_(box), x_(x), y_(y) {}

  glm::dvec2 at(double x, double y) const noexcept;  // position of a data point on the page
  // Grid lines at every multiple of `step`; x_grid() and y_grid() also write the numbers.
  void x_lines(double step) const;
  void x_grid(double step) const;
  void y_grid(double step) const;
  void x_name(std::string_view text) const;  // axis label below the numbers
  void y_name(std::string_view text) const;  // axis label above the box

 private:
  base::Svg& svg_;
  base::Rect box_;
  ChartRange x_, y_;
};

// The smallest step of 1, 2 or 5 times a power of ten that puts at most `max_lines` lines into `span`.
double grid_step(double span, int max_lines) noexcept;

}  // namespace gearshift::lessons
