// A plot: background, grid, axis numbers and curves.
#pragma once

#include <imgui.h>

#include "app/ui/panel/strip.h"

namespace gearshift::ui {

struct PlotRange {
  double low = 0.0, high = 1.0;
};

// The smallest of 1, 2, 5, 10, 20, 50, ... (times `min`) that is not below `value`; both are positive.
double nice_above(double value, double min);

class PlotArea {
 public:
  // Takes `size` [px] at the cursor and draws background and grid. Numbers of y are inside, at the left; numbers of x,
  // if it has a unit, below. Numbers that would touch another one are left out, except the outermost. beside: numbers
  // of y are to the left of the cursor, where there must be room.
  PlotArea(ImVec2 size, PlotRange x, PlotRange y, const char* x_unit, bool beside = false);
  ~PlotArea();
  PlotArea(const PlotArea&) = delete;
  PlotArea& operator=(const PlotArea&) = delete;

  ImVec2 at(double x, double y) const;
  int columns() const { return static_cast<int>(high_.x - low_.x); }  // pixel columns

  void strip(const Strip& strip, double factor, ImU32 colour);  // the strip's span fills the width
  ImDrawList& list() { return *list_; }

 private:
  template <class Visit>
  static void each_line(PlotRange range, float pixels_per_line, float pixels, Visit visit);
  template <class Visit>
  void each_y(Visit visit) const;
  template <class Visit>
  void each_x(Visit visit) const;
  void draw_grid();
  void number_y();
  float number_top(double y) const;
  void number_y_at(double y);
  void number_x();

  ImDrawList* list_;
  ImVec2 low_, high_;  // [px] corners
  PlotRange x_, y_;
  const char* x_unit_;
  bool beside_;
};

}  // namespace gearshift::ui
