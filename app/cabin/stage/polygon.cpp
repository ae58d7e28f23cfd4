#include "app/cabin/stage/polygon.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include <glm/geometric.hpp>

namespace gearshift::cabin {
namespace {

double cross(glm::dvec2 a, glm::dvec2 b) noexcept {
  return a.x * b.y - a.y * b.x;
}

double turn(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) noexcept {
  return cross(b - a, c - b);
}

double distance_to_chord(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b) noexcept {
  const glm::dvec2 chord = b - a;
  const double length_2 = glm::dot(chord, chord);
  const double along = length_2 > 0.0 ? std::clamp(glm::dot(p - a, chord) / length_2, 0.0, 1.0) : 0.0;
  return glm::distance(p, a + along * chord);
}

// Marks the points to keep between `first` and `last`. These two end points are kept in any case.
void keep_corners(const Loop& line, std::size_t first, std::size_t last, double tolerance, std::vector<char>& keep) {
  double worst = tolerance;
  std::size_t corner = first;
  for (std::size_t i = first + 1; i < last; ++i) {
    const double off = distance_to_chord(line[i], line[first], line[last]);
    if (off > worst) {
      worst = off;
      corner = i;
    }
  }
  if (corner == first) return;
  keep[corner] = 1;
  keep_corners(line, first, corner, tolerance, keep);
  keep_corners(line, corner, last, tolerance, keep);
}

bool inside(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) noexcept {
  return cross(b - a, p - a) >= 0.0 && cross(c - b, p - b) >= 0.0 && cross(a - c, p - c) >= 0.0;
}

class EarClipper {
 public:
  EarClipper(const Loop& points, std::vector<std::uint32_t> ring) : points_(points), ring_(std::move(ring)) {}

  std::vector<std::uint32_t> clip() {
    std::size_t i = 0, tried = 0;
    while (ring_.size() > 3) {
      if (tried++ > ring_.size()) throw std::runtime_error("the outline of a plate crosses itself");
      i %= ring_.size();
      if (!is_ear(i)) {
        ++i;
        continue;
      }
      emit(i);
      ring_.erase(ring_.begin() + static_cast<std::ptrdiff_t>(i));
      tried = 0;
    }
    emit(1);
    return std::move(triangles_);
  }

 private:
  glm::dvec2 at(std::size_t i) const { return points_[ring_[i % ring_.size()]]; }

  bool is_ear(std::size_t i) const {
    const std::size_t n = ring_.size();
    const glm::dvec2 a = at(i + n - 1), b = at(i), c = at(i + 1);
    if (turn(a, b, c) <= 0.0) return false;
    for (std::size_t j = 0; j < n; ++j) {
      const glm::dvec2 p = at(j);
      if (p == a || p == b || p == c) continue;  // skips copies of a corner: each end of the bridge occurs twice
      if (inside(p, a, b, c)) return false;
    }
    return true;
  }

  void emit(std::size_t i) {
    const std::size_t n = ring_.size();
    triangles_.insert(triangles_.end(), {ring_[(i + n - 1) % n], ring_[i % n], ring_[(i + 1) % n]});
  }

  const Loop& points_;
  std::vector<std::uint32_t> ring_;
  std::vector<std::uint32_t> triangles_;
};

// Finds a vertex of the convex outline that is visible from `from`, the hole's rightmost point. Takes the outline's
// edge to the right of `from`, and returns the end of this edge that is further to the right. No point of the hole can
// then be between `from` and the vertex.
std::size_t bridge_end(const Loop& outline, glm::dvec2 from) {
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const std::size_t next = (i + 1) % outline.size();
    const glm::dvec2 a = outline[i], b = outline[next];
    if (a.y <= from.y && from.y < b.y)
      return a.x >= b.x ? i : next;  // an upward edge is on the right side of a counter-clockwise loop
  }
  throw std::runtime_error("the slots of the gate extend beyond its plate");
}

}  // namespace

double signed_area(const Loop& loop) noexcept {
  double twice = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) twice += cross(loop[i], loop[(i + 1) % loop.size()]);
  return 0.5 * twice;
}

Loop simplified(const Loop& loop, double tolerance) {
  if (loop.size() < 4) return loop;
  // The loop is split at two points that are certainly corners: the point furthest from the loop's first point, and the
  // point furthest from that corner.
  const auto furthest = [&](std::size_t from) {
    std::size_t best = from;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      if (glm::distance(loop[i], loop[from]) > glm::distance(loop[best], loop[from])) best = i;
    }
    return best;
  };
  Loop line = loop;
  std::rotate(line.begin(), line.begin() + static_cast<std::ptrdiff_t>(furthest(0)), line.end());
  std::size_t opposite = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (glm::distance(line[i], line[0]) > glm::distance(line[opposite], line[0])) opposite = i;
  }
  line.push_back(line.front());
  std::vector<char> keep(line.size(), 0);
  keep[0] = keep[opposite] = 1;
  keep_corners(line, 0, opposite, tolerance, keep);
  keep_corners(line, opposite, line.size() - 1, tolerance, keep);
  Loop corners;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    if (keep[i] != 0) corners.push_back(line[i]);
  }
  return corners;
}

std::vector<std::uint32_t> triangulate(const Loop& outline, const Loop& hole) {
  Loop points = outline;
  points.insert(points.end(), hole.begin(), hole.end());
  const auto right = std::max_element(hole.begin(), hole.end(), [](auto a, auto b) { return a.x < b.x; });
  const std::size_t start = static_cast<std::size_t>(right - hole.begin());
  const std::size_t end = bridge_end(outline, *right);
  std::vector<std::uint32_t> ring;
  for (std::size_t i = 0; i <= outline.size(); ++i) {
    ring.push_back(static_cast<std::uint32_t>((end + i) % outline.size()));
  }
  for (std::size_t i = 0; i <= hole.size(); ++i) {
    ring.push_back(static_cast<std::uint32_t>(outline.size() + (start + i) % hole.size()));
  }
  return EarClipper(points, std::move(ring)).clip();
}

Loop rounded_rectangle(glm::dvec2 half, double radius, int steps_per_corner) {
  Loop loop;
  for (int corner = 0; corner < 4; ++corner) {
    const glm::dvec2 sign{corner == 0 || corner == 3 ? 1.0 : -1.0, corner < 2 ? 1.0 : -1.0};
    for (int step = 0; step <= steps_per_corner; ++step) {
      const double angle = std::numbers::pi / 2.0 * (corner + static_cast<double>(step) / steps_per_corner);
      loop.push_back(sign * (half - radius) + radius * glm::dvec2(std::cos(angle), std::sin(angle)));
    }
  }
  return loop;
}

}  // namespace gearshift::cabin
