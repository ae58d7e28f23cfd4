#include "app/lessons/assessment/gate_path.h"

#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

namespace gearshift::lessons {
namespace {

using glm::dvec2;

constexpr double kSlack = 1e-4;  // [m] tolerance, so that the path may touch a corner
constexpr double kStep = 5e-4;   // [m] spacing of the points checked on a path segment

bool is_free(const haptics::Gate& gate, dvec2 from, dvec2 to) {
  const int parts = 1 + static_cast<int>(glm::distance(from, to) / kStep);
  for (int i = 0; i <= parts; ++i) {
    if (!haptics::in_free_space(gate, from + (to - from) * (static_cast<double>(i) / parts), kSlack)) return false;
  }
  return true;
}

// Returns the corners at which the shortest path towards x leaves the slot that contains `point`, innermost first.
std::vector<dvec2> corners(const haptics::Gate& gate, dvec2 point, double x) {
  if (std::abs(point.y) <= gate.half_aisle) return {};
  const haptics::Column& column = haptics::column_of(gate, haptics::nearest_column(gate, point.x));
  const double side = std::copysign(1.0, x - column.center), up = std::copysign(1.0, point.y);
  const dvec2 deep{column.center + side * column.half_width, up * (gate.half_aisle + gate.chamfer)};
  const dvec2 shallow{column.center + side * (column.half_width + gate.chamfer), up * gate.half_aisle};
  return {deep, shallow};
}

double length_of(const std::vector<dvec2>& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length += glm::distance(path[i - 1], path[i]);
  return length;
}

bool is_free(const haptics::Gate& gate, const std::vector<dvec2>& path) {
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (!is_free(gate, path[i - 1], path[i])) return false;
  }
  return true;
}

// Returns the path from `from` to `to` through those of the `bends` whose bit is set in `chosen`.
std::vector<dvec2> path_over(dvec2 from, const std::vector<dvec2>& bends, std::size_t chosen, dvec2 to) {
  std::vector<dvec2> path{from};
  const auto go = [&](dvec2 next) {
    if (next != path.back()) path.push_back(next);
  };
  for (std::size_t i = 0; i < bends.size(); ++i) {
    if ((chosen >> i & 1u) != 0) go(bends[i]);
  }
  go(to);
  return path;
}

}  // namespace

std::vector<dvec2> shortest_path(const haptics::Gate& gate, dvec2 from, dvec2 to) {
  std::vector<dvec2> straight = path_over(from, {}, 0, to);
  if (is_free(gate, straight)) return straight;
  std::vector<dvec2> bends = corners(gate, from, to.x);
  const std::vector<dvec2> last = corners(gate, to, from.x);
  bends.insert(bends.end(), last.rbegin(), last.rend());

  std::vector<dvec2> best = std::move(straight);
  double shortest = std::numeric_limits<double>::max();
  for (std::size_t chosen = 1; chosen < (std::size_t{1} << bends.size()); ++chosen) {
    std::vector<dvec2> path = path_over(from, bends, chosen, to);
    const double length = length_of(path);
    if (length >= shortest || !is_free(gate, path)) continue;
    shortest = length;
    best = std::move(path);
  }
  return best;
}

double shortest_path_length(const haptics::Gate& gate, dvec2 from, dvec2 to) {
  return length_of(shortest_path(gate, from, to));
}

}  // namespace gearshift::lessons
