#include "app/ui/panel/trail.h"

#include <algorithm>

#include <glm/geometric.hpp>

namespace gearshift::ui {
namespace {

// A point is added to the trail if its difference from the trail's newest point exceeds at least one of these limits.
constexpr double kMinTrailDistance = 0.3e-3;  // [m]
constexpr double kMinTrailForce = 0.5;        // [N]
constexpr double kMaxTrailStep = 0.05;        // [s]

bool is_distinct(const TrailPoint& last, const TrailPoint& next) {
  return next.time - last.time > kMaxTrailStep || glm::distance(next.lever, last.lever) > kMinTrailDistance ||
         glm::distance(next.commanded, last.commanded) > kMinTrailForce;
}

}  // namespace

void Trail::push(const haptics::HapticSnapshot& snapshot) {
  const TrailPoint next{1e-9 * static_cast<double>(snapshot.time_ns), snapshot.lever, snapshot.commanded};
  if (next.time < now_) points_.clear();
  now_ = next.time;
  if (points_.empty() || is_distinct(points_.back(), next)) points_.push_back(next);
  while (points_.front().time < now_ - kSpan) points_.pop_front();
}

double Trail::age(const TrailPoint& point) const noexcept {
  return std::clamp((now_ - point.time) / kSpan, 0.0, 1.0);
}

}  // namespace gearshift::ui
