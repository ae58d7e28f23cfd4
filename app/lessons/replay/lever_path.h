// Collects the path of the displayed lever in a shift and computes the shortest possible path.
#pragma once

#include <cstddef>
#include <vector>

#include <glm/vec2.hpp>

#include "app/lessons/assessment/shift_record.h"
#include "haptics/gate/gate.h"

namespace gearshift::lessons {

struct ShiftPaths {
  // [m] Path from leaving the old gear to engaging the new gear. A shift from neutral: from the first movement. A shift
  // in which no gear was engaged: to the end of the shift.
  std::vector<glm::dvec2> driven;
  std::vector<glm::dvec2> ideal;  // [m] shortest path between the ends of `driven`, see shortest_path()
};

// Receives every cycle of a shift, but stores only points that are one chord apart. So the ends of a path are accurate
// to one chord length.
class LeverPath {
 public:
  void clear();                             // call at the start of each shift
  void add(double time, glm::dvec2 place);  // time: [s] on the loop's clock, increasing; place: [m] displayed lever
  // Returns empty paths if nothing was added. gate: the gate in which the shift was driven.
  ShiftPaths paths(const ShiftRecord& shift, const haptics::Gate& gate) const;

  static constexpr double kChord = 5e-4;  // [m] initial chord length; doubled when a path exceeds kMaxPoints
  static constexpr std::size_t kMaxPoints = 4096;

 private:
  struct Point {
    double time;
    glm::dvec2 place;
  };

  void coarsen();

  double chord_ = kChord;
  std::vector<Point> points_;
};

}  // namespace gearshift::lessons
