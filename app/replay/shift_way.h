// The way that the drawn lever took in a shift, and the shortest that it could have taken.
#pragma once

#include <cstddef>
#include <vector>

#include <glm/vec2.hpp>

#include "app/training/shift_record.h"
#include "haptics/gate/gate.h"

namespace gearshift {

struct ShiftWays {
  std::vector<glm::dvec2> driven;  // [m] from the gear that was left (out of neutral: from its first movement) to the
                                   // one that came; where none came, to the shift's end
  std::vector<glm::dvec2> ideal;   // [m] the shortest way between driven's ends, see shortest_path()
};

// Every cycle of a shift, kept as chords: a way's ends are good to one of these.
class ShiftWay {
 public:
  void clear();                             // the next shift
  void add(double time, glm::dvec2 place);  // [s] on the loop's clock, rising; [m] of the drawn lever
  // Empty ones where nothing was added. The gate is the one that it was driven in.
  ShiftWays ways(const ShiftRecord& shift, const Gate& gate) const;

  static constexpr double kChord = 5e-4;  // [m]; longer where a way would have more than kMostPoints
  static constexpr std::size_t kMostPoints = 4096;

 private:
  struct Point {
    double time;
    glm::dvec2 place;
  };

  void coarsen();

  double chord_ = kChord;
  std::vector<Point> points_;
};

}  // namespace gearshift
