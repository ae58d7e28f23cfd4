#include "haptics/gate/aisle.h"

#include <algorithm>
#include <cmath>

namespace gearshift::haptics {
namespace {

using glm::dvec2;

void include(LineInterval& hull, LineInterval part) noexcept {
  if (part.high < part.low) return;
  if (hull.high < hull.low)
    hull = part;
  else
    hull = {std::min(hull.low, part.low), std::max(hull.high, part.high)};
}

LineInterval line_in_disc(dvec2 center, double radius, dvec2 p, dvec2 direction) noexcept {
  const double middle = glm::dot(center - p, direction);
  const dvec2 off = center - p - middle * direction;
  const double half_squared = radius * radius - glm::dot(off, off);
  if (half_squared < 0.0) return {};
  const double half = std::sqrt(half_squared);
  return {middle - half, middle + half};
}

// Limits the interval of t to low <= at + t * rate <= high.
void clip(LineInterval& interval, double at, double rate, double low, double high) noexcept {
  if (std::abs(rate) < 1e-12) {
    if (at < low || at > high) interval = {};
    return;
  }
  const double a = (low - at) / rate, b = (high - at) / rate;
  interval = {std::max(interval.low, std::min(a, b)), std::min(interval.high, std::max(a, b))};
}

double cross(dvec2 a, dvec2 b) noexcept {
  return a.x * b.y - a.y * b.x;
}

}  // namespace

// The part is convex, so the interval is the hull of the intervals in its two end discs and in the rectangle between.
LineInterval line_inside(const AislePart& part, dvec2 p, dvec2 direction) noexcept {
  if (part.high < part.low) return {};
  const Aisle& aisle = part.aisle;
  const dvec2 across{-aisle.along.y, aisle.along.x};
  constexpr double kFar = 10.0;  // [m] farther than any device reaches
  LineInterval hull{-kFar, kFar};
  clip(hull, position_along(aisle, p), glm::dot(direction, aisle.along), part.low, part.high);
  clip(hull, glm::dot(p - aisle.from, across), glm::dot(direction, across), -aisle.half_width, aisle.half_width);
  for (const double end : {part.low, part.high})
    include(hull, line_in_disc(aisle.from + end * aisle.along, aisle.half_width, p, direction));
  return hull;
}

// The unit vectors that lead from a meeting point along the aisle: one at its end, otherwise two.
std::vector<dvec2> ways_from(const Aisle& aisle, dvec2 at) {
  std::vector<dvec2> ways;
  if (glm::distance(at, aisle.to) > kOnLine) ways.push_back(aisle.along);
  if (glm::distance(at, aisle.from) > kOnLine) ways.push_back(-aisle.along);
  return ways;
}

std::optional<dvec2> meeting_point(const Aisle& a, const Aisle& b) noexcept {
  for (const dvec2 end : {b.from, b.to})
    if (distance_to(a, end) < kOnLine) return end;
  for (const dvec2 end : {a.from, a.to})
    if (distance_to(b, end) < kOnLine) return end;
  const double turn = cross(a.along, b.along);
  if (std::abs(turn) < 1e-9) return std::nullopt;
  const double s = cross(b.from - a.from, b.along) / turn, t = cross(b.from - a.from, a.along) / turn;
  if (s < 0.0 || s > a.length || t < 0.0 || t > b.length) return std::nullopt;
  return a.from + s * a.along;
}

// The width of the cross-section that lies inside `b` is a concave function of the position, so the positions at which it
// is not empty are an interval round the meeting point. Both ends are found by bisection.
LineInterval overlap_along(const Aisle& a, const Aisle& b) noexcept {
  const dvec2 across{-a.along.y, a.along.x};
  const auto meets = [&](double s) {
    const LineInterval inside = line_inside(whole(b), a.from + s * a.along, across);
    return inside.low <= inside.high && inside.low <= a.half_width && inside.high >= -a.half_width;
  };
  const double center = std::clamp(position_along(a, meeting_point(a, b).value_or(a.from)), 0.0, a.length);
  const auto edge = [&](double in, double out) {
    if (meets(out)) return out;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (in + out);
      (meets(middle) ? in : out) = middle;
    }
    return out;
  };
  return {edge(center, 0.0), edge(center, a.length)};
}

// Where other aisles meet this one, in order along it.
std::vector<LineInterval> overlaps_of(const Gate& gate, std::size_t index) {
  std::vector<LineInterval> found;
  const auto all = aisles(gate);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (i != index && meeting_point(all[index], all[i])) found.push_back(overlap_along(all[index], all[i]));
  std::sort(found.begin(), found.end(), [](LineInterval a, LineInterval b) { return a.low < b.low; });
  std::vector<LineInterval> joined;
  for (const LineInterval& one : found) {
    if (!joined.empty() && one.low <= joined.back().high)
      joined.back().high = std::max(joined.back().high, one.high);
    else
      joined.push_back(one);
  }
  return joined;
}

// The free stretches of an aisle between the places where it meets others.
std::vector<LineInterval> stretches_of(const Gate& gate, std::size_t index) {
  std::vector<LineInterval> stretches;
  double from = 0.0;
  for (const LineInterval& overlap : overlaps_of(gate, index)) {
    if (overlap.low > from) stretches.push_back({from, overlap.low});
    from = std::max(from, overlap.high);
  }
  const double length = gate.aisle[index].length;
  if (length > from) stretches.push_back({from, length});
  return stretches;
}

}  // namespace gearshift::haptics
