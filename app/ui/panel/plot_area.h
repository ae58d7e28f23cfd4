// A plot: background, grid, axis numbers and curves.
#pragma once

#include <imgui.h>

#include "app/ui/panel/strip.h"

namespace gearshift::ui {

struct PlotRange {
  double low = 0.0, high = 1.0;
};

// Returns the smallest of `min` times 1, 2, 5, 10, 20, 50, ... that is not below `value`. Requires positive arguments.
double nice_above(double value, double min);

class PlotArea {
 public:
  // Covers `size` [px] at ImGui's cursor and draws background and grid. The numbers of the y axis are inside the plot,
  // at the left; if they would overlap, some are left out. The numbers of the x axis are below the plot; if x_unit is
  // null, there are none. numbers_outside: the numbers of the y axis are to the left of the cursor, where the caller
  // must leave space for them.
  PlotArea(ImVec2 size, PlotRange x, PlotRange y, const char* x_unit, bool numbers_outside = false);
  ~PlotArea();
  PlotArea(const PlotArea&) = delete;
  PlotArea& operator=(const PlotArea&) = delete;

  ImVec2 at(double x, double y) const;
  int columns() const { return static_cast<int>(high_.x - low_.x); }  // width of the plot in pixel columns

  void strip(const Strip& strip, double factor, ImU32 colour);  // draws the strip across the full width
  ImDrawList& list() { return *list_; }

 private:
  template <class Visit>
  static void each_line(PlotRange range, float pixels_per_line, float pixels, Visit visit);
  template <class Visit>
  void each_y(Visit visit) const;
  template <class Visit>
  void each_x(Visit visit) const;
  void draw_grid();
  void draw_y_numbers();
  float y_number_top(double y) const;
  void draw_y_number(double y);
  void draw_x_numbers();

  ImDrawList* list_;
  ImVec2 low_, high_;  // [px] upper left and lower right corner
  PlotRange x_, y_;
  const char* x_unit_;
  bool numbers_outside_;
};

}  // namespace gearshift::ui
