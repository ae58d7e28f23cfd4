#include "app/replay/shift_way.h"

#include <glm/geometric.hpp>

#include "app/replay/shift_times.h"
#include "app/training/gate_path.h"

namespace gearshift {
namespace {

constexpr double kAddedUp = 1e-7;  // [s] of times that were added up

}  // namespace

void ShiftWay::clear() {
  points_.clear();
  chord_ = kChord;
}

void ShiftWay::add(double time, glm::dvec2 place) {
  if (!points_.empty() && glm::distance(place, points_.back().place) < chord_) return;
  points_.push_back({time, place});
  if (points_.size() >= kMostPoints) coarsen();
}

// Every other point; from here on a way is as fine as it is left now.
void ShiftWay::coarsen() {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < points_.size(); i += 2) points_[kept++] = points_[i];
  points_.resize(kept);
  chord_ *= 2.0;
}

// At any time the lever is within a chord of the last point not after it.
ShiftWays ShiftWay::ways(const ShiftRecord& shift, const Gate& gate) const {
  const ShiftTimes times = shift_times(shift);
  const double left = shift.from == kNeutralGear ? 0.0 : times.lever_left.value_or(0.0);
  const double from = shift.begin + left + kAddedUp, to = shift.begin + times.gear_in.value_or(times.end) + kAddedUp;
  ShiftWays ways;
  for (const Point& point : points_) {
    if (point.time > to && !ways.driven.empty()) break;
    if (point.time <= from) ways.driven.clear();
    ways.driven.push_back(point.place);
  }
  if (!ways.driven.empty()) ways.ideal = shortest_path(gate, ways.driven.front(), ways.driven.back());
  return ways;
}

}  // namespace gearshift
