#include "app/lab/bench/pareto.h"

#include <algorithm>
#include <cmath>

namespace gearshift::lab {
namespace {

bool is_finite(glm::dvec2 p) {
  return std::isfinite(p.x) && std::isfinite(p.y);
}

bool beats(glm::dvec2 a, glm::dvec2 b) {
  return is_finite(a) && a.x <= b.x && a.y <= b.y && (a.x < b.x || a.y < b.y);
}

}  // namespace

std::vector<std::size_t> pareto_front(const std::vector<glm::dvec2>& points) {
  std::vector<std::size_t> front;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto beats_it = [&](glm::dvec2 other) { return beats(other, points[i]); };
    if (is_finite(points[i]) && std::none_of(points.begin(), points.end(), beats_it)) front.push_back(i);
  }
  std::stable_sort(front.begin(), front.end(), [&](std::size_t a, std::size_t b) { return points[a].x < points[b].x; });
  return front;
}

}  // namespace gearshift::lab
