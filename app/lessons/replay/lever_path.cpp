#include "app/lessons/replay/lever_path.h"

#include <glm/geometric.hpp>

#include "app/lessons/assessment/gate_path.h"
#include "app/lessons/replay/shift_times.h"

namespace gearshift::lessons {
namespace {

constexpr double kTimeTolerance = 1e-7;  // [s] tolerance for rounding errors of summed times

}  // namespace

void LeverPath::clear() {
  points_.clear();
  chord_ = kChord;
}

void LeverPath::add(double time, glm::dvec2 place) {
  if (!points_.empty() && glm::distance(place, points_.back().place) < chord_) return;
  points_.push_back({time, place});
  if (points_.size() >= kMaxPoints) coarsen();
}

// Drops every other point, and doubles the distance at which later points are stored.
void LeverPath::coarsen() {
  std::size_t count = 0;
  for (std::size_t i = 0; i < points_.size(); i += 2) points_[count++] = points_[i];
  points_.resize(count);
  chord_ *= 2.0;
}

// Each path begins at the last point stored before its start time, and ends at the last point stored before its end
// time. At these times, the lever is within one chord length of the points.
ShiftPaths LeverPath::paths(const ShiftRecord& shift, const haptics::Gate& gate) const {
  const ShiftTimes times = shift_times(shift);
  const double left = shift.from == haptics::kNeutralGear ? 0.0 : times.lever_left.value_or(0.0);
  const double from = shift.begin + left + kTimeTolerance,
               to = shift.begin + times.gear_in.value_or(times.end) + kTimeTolerance;
  ShiftPaths paths;
  for (const Point& point : points_) {
    if (point.time > to && !paths.driven.empty()) break;
    if (point.time <= from) paths.driven.clear();
    paths.driven.push_back(point.place);
  }
  if (!paths.driven.empty()) paths.ideal = shortest_path(gate, paths.driven.front(), paths.driven.back());
  return paths;
}

}  // namespace gearshift::lessons
