// A well with a grid, numbers and curves in it.
#pragma once

#include <imgui.h>

#include "app/panel/strip.h"

namespace gearshift {

struct PlotRange {
  double low = 0.0, high = 1.0;
};

// The least of 1, 2, 5, 10, 20, 50, ... (times `least`) that is not below the value, both positive.
double nice_above(double value, double least);

class PlotArea {
 public:
  // Takes that size of the window at the cursor [px] and draws well and grid. Numbers of y stand inside, at the left;
  // of x, where it has a unit, below the well. What would touch another number is left out, the extreme ones stay.
  // beside: those of y stand to the left of the cursor, where there must be room.
  PlotArea(ImVec2 size, PlotRange x, PlotRange y, const char* x_unit, bool beside = false);
  ~PlotArea();
  PlotArea(const PlotArea&) = delete;
  PlotArea& operator=(const PlotArea&) = delete;

  ImVec2 at(double x, double y) const;
  int columns() const { return static_cast<int>(high_.x - low_.x); }  // of pixels

  void strip(const Strip& strip, double factor, ImU32 colour);  // its whole span over the whole width
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

}  // namespace gearshift
