// Axes, grids, numbers and curves of SVG plots. The verbs tour, identify and reproduce draw with gnuplot instead.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>

#include "app/base/svg.h"

namespace gearshift::base {

// The values along one side of a plot.
class Scale {
 public:
  Scale(double from, double to) : from_(from), to_(to) {}  // linear

  // Logarithmic from one positive value to another.
  static Scale decades(double from, double to);
  // Logarithmic, spans the values with a margin. Values <= 0 are placed at the start of the axis, at least a decade
  // below the smallest positive value. NaN and infinity are ignored.
  static Scale decades_around(const std::vector<double>& values);

  double from() const noexcept { return from_; }
  double to() const noexcept { return to_; }
  bool is_logarithmic() const noexcept { return logarithmic_; }
  // Position of a value: 0 at the start, 1 at the end. On a logarithmic axis at most 1, and -1 for values <= 0 without
  // a place on the axis.
  double fraction(double value) const noexcept;

  struct Tick {
    double value = 0.0;
    bool named = true;
  };
  // Multiples of `step`; on a logarithmic axis, decades, or 1, 2 and 5 in every decade if `max_named` numbers are enough
  // for that.
  std::vector<Tick> ticks(double step, double max_named) const;

 private:
  double from_, to_;
  bool logarithmic_ = false;
  bool zero_ = false;  // the axis starts with 0, one decade before the other values
};

class Chart {
 public:
  // text: height of the numbers [units of the page]
  Chart(Svg& svg, const Rect& box, const Scale& x, const Scale& y, double text = 12.0)
      : svg_(svg), box_(box), x_(x), y_(y), text_(text) {}

  glm::dvec2 at(double x, double y) const noexcept;  // position of a data point on the page

  // Grid lines at every multiple of `step`, which a logarithmic axis ignores; x_grid() and y_grid() also write the
  // numbers. A horizontal line at 0 inside the plot is darker.
  void x_lines(double step = 0.0) const;
  void x_grid(double step = 0.0) const;
  void y_grid(double step = 0.0) const;
  void x_name(std::string_view text) const;  // axis label below the numbers
  void y_name(std::string_view text) const;  // axis label above the box

  // Data points, joined or filled, as far as they are inside the box.
  void curve(const std::vector<glm::dvec2>& data, const Pen& pen) const;
  void area(const std::vector<glm::dvec2>& data, std::string_view fill) const;

 private:
  std::vector<glm::dvec2> on_page(const std::vector<glm::dvec2>& data) const;
  Pen grid_pen(bool is_zero = false) const noexcept;
  std::vector<Scale::Tick> x_ticks(double step) const;

  Svg& svg_;
  Rect box_;
  Scale x_, y_;
  double text_;
};

// A figure against a positive value, such as a frequency.
struct Curve {
  std::string x_name, y_name;  // axis labels
  std::vector<glm::dvec2> points;
};

// Draws the curve and its points, on a logarithmic axis, from 0 or below to 1 or above. `text`: as in Chart
void draw_curve(Svg& svg, const Rect& box, const Curve& curve, double text);

// The smallest step of 1, 2 or 5 times a power of ten that puts at most `max_lines` lines into `span`.
double grid_step(double span, int max_lines) noexcept;

}  // namespace gearshift::base
