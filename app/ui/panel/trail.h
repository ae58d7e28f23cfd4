// Lever path and commanded force in the last seconds, thinned to what the eye can resolve.
#pragma once

#include <deque>

#include "haptics/loop/haptic_snapshot.h"

namespace gearshift::ui {

struct TrailPoint {
  double time = 0.0;          // [s]
  glm::dvec2 lever{0.0};      // [m]
  glm::dvec2 commanded{0.0};  // [N]
};

class Trail {
 public:
  static constexpr double kSpan = 3.0;  // [s]

  void push(const haptics::HapticSnapshot& snapshot);  // a time earlier than the last one clears the trail first
  const std::deque<TrailPoint>& points() const noexcept { return points_; }
  double age(const TrailPoint& point) const noexcept;  // [1] 0: new; 1: as old as kSpan, about to be dropped

 private:
  std::deque<TrailPoint> points_;  // oldest first
  double now_ = 0.0;               // [s] time of the last snapshot
};

}  // namespace gearshift::ui
