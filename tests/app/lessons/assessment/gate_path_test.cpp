// Tests the shortest path through a gate against lengths computed by hand, a grid search and a visibility graph.
#include "app/lessons/assessment/gate_path.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <queue>
#include <random>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "tests/support/gates.h"

using namespace gearshift::haptics;
using namespace gearshift::lessons;
using namespace gearshift::test;
using glm::dvec2;

namespace {

// [m] The length of the shortest path by Dijkstra's algorithm on a 1 mm grid, with moves of up to five cells in x and
// y. The result is at most 2 % longer than the true path.
double grid_path_length(const Gate& gate, dvec2 from, dvec2 to) {
  constexpr double kCell = 1e-3;
  constexpr int kReach = 5, kHalfWide = 80, kHalfHigh = 60;
  constexpr int kWide = 2 * kHalfWide + 1, kHigh = 2 * kHalfHigh + 1;
  const auto cell = [](dvec2 p) {
    return std::pair<int, int>{static_cast<int>(std::lround(p.x / kCell)) + kHalfWide,
                               static_cast<int>(std::lround(p.y / kCell)) + kHalfHigh};
  };
  const auto place = [](int i, int j) { return dvec2{(i - kHalfWide) * kCell, (j - kHalfHigh) * kCell}; };
  std::vector<double> best(std::size_t{kWide} * kHigh, 1e9);
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  const auto [i0, j0] = cell(from);
  const auto [i1, j1] = cell(to);
  const int start = j0 * kWide + i0;
  best[static_cast<std::size_t>(start)] = 0.0;
  open.emplace(0.0, start);
  while (!open.empty()) {
    const auto [length, index] = open.top();
    open.pop();
    if (index == j1 * kWide + i1) return length;
    if (length > best[static_cast<std::size_t>(index)]) continue;
    const int i = index % kWide, j = index / kWide;
    for (int di = -kReach; di <= kReach; ++di) {
      for (int dj = -kReach; dj <= kReach; ++dj) {
        if (i + di < 0 || i + di >= kWide || j + dj < 0 || j + dj >= kHigh) continue;
        const dvec2 a = place(i, j), b = place(i + di, j + dj);
        bool free = true;
        for (int k = 1; k <= 5 && free; ++k) free = in_free_space(gate, a + (b - a) * (k / 5.0), 1e-6);
        if (!free) continue;
        const int next = (j + dj) * kWide + i + di;
        const double there = length + glm::distance(a, b);
        if (there >= best[static_cast<std::size_t>(next)]) continue;
        best[static_cast<std::size_t>(next)] = there;
        open.emplace(there, next);
      }
    }
  }
  return 1e9;
}

// A visibility graph: all corners at which a taut string could bend, and the straight lines between them that do not
// cross a wall. Each line is checked every 0.1 mm.
class VisibilityGraph {
 public:
  explicit VisibilityGraph(const Gate& gate) : gate_(gate) {
    for (const Column& column : columns(gate)) {
      for (const double side : {-1.0, 1.0}) {
        for (const double up : {-1.0, 1.0}) {
          corners_.push_back({column.center + side * column.half_width, up * (gate.half_aisle + gate.chamfer)});
          corners_.push_back({column.center + side * (column.half_width + gate.chamfer), up * gate.half_aisle});
        }
      }
    }
    std::erase_if(corners_, [&](dvec2 p) { return !in_free_space(gate, p, kTouch); });
    for (const dvec2 a : corners_) {
      legs_.emplace_back();
      for (const dvec2 b : corners_) legs_.back().push_back(leg(a, b));
    }
  }

  // The Bellman-Ford algorithm. Six rounds suffice, because no shortest path has more than six bends.
  double path_length(dvec2 from, dvec2 to) const {
    std::vector<double> best;
    double shortest = leg(from, to);
    for (const dvec2 corner : corners_) best.push_back(leg(from, corner));
    for (std::size_t round = 0; round < 6; ++round) {
      for (std::size_t i = 0; i < best.size(); ++i)
        for (std::size_t j = 0; j < best.size(); ++j) best[j] = std::min(best[j], best[i] + legs_[i][j]);
    }
    for (std::size_t i = 0; i < best.size(); ++i) shortest = std::min(shortest, best[i] + leg(corners_[i], to));
    return shortest;
  }

 private:
  static constexpr double kTouch = 1e-6;  // [m] tolerance for touching a wall

  double leg(dvec2 a, dvec2 b) const {
    const int parts = 1 + static_cast<int>(glm::distance(a, b) / 1e-4);
    for (int i = 0; i <= parts; ++i) {
      if (!in_free_space(gate_, a + (b - a) * (static_cast<double>(i) / parts), kTouch)) return 1e9;
    }
    return glm::distance(a, b);
  }

  const Gate& gate_;
  std::vector<dvec2> corners_;
  std::vector<std::vector<double>> legs_;
};

std::vector<dvec2> random_points(const Gate& gate, std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> x(-0.07, 0.07), y(-0.05, 0.05);
  std::vector<dvec2> points;
  while (points.size() < count) {
    const dvec2 p{x(random), y(random)};
    if (in_free_space(gate, p)) points.push_back(p);
  }
  return points;
}

double length_of(const std::vector<dvec2>& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length += glm::distance(path[i - 1], path[i]);
  return length;
}

}  // namespace

TEST_CASE("within a column the path is straight; around a wall it touches the wall's corners") {
  const Gate gate = paper_gate();  // [mm] half aisle 6, chamfer 4, half slot 5, columns at -30, 0, 30
  CHECK(shortest_path_length(gate, {0.0, 0.030}, {0.0, -0.030}) == doctest::Approx(0.060));
  CHECK(shortest_path_length(gate, {-0.03, 0.0}, {0.03, 0.0}) == doctest::Approx(0.060));
  // [mm] The path from (-30, 30) to (0, 30) bends at (-25, 10), (-21, 6), (-9, 6) and (-5, 10).
  const double up = std::hypot(0.005, 0.020), round = std::hypot(0.004, 0.004);
  CHECK(shortest_path_length(gate, {-0.03, 0.03}, {0.0, 0.03}) ==
        doctest::Approx(2 * up + 2 * round + 0.012).epsilon(1e-9));
}

TEST_CASE("the shortest path is as long as that of a grid search, in three gates") {
  for (const std::string& name : {std::string("paper"), std::string("four_speed"), std::string("dog_leg_five")}) {
    CAPTURE(name);
    const Gate gate = shipped_gate(name);
    for (const Slot& a : slots(gate)) {
      const Slot& b = slot_of(gate, (static_cast<int>(&a - gate.slot.data()) + 3) % gate.slot_count);
      const auto rounded = [](dvec2 p) { return dvec2{std::round(1e3 * p.x) / 1e3, std::round(1e3 * p.y) / 1e3}; };
      const dvec2 from = rounded(rest_position(gate, a.gear)), to = rounded(rest_position(gate, b.gear));
      const double length = shortest_path_length(gate, from, to), grid = grid_path_length(gate, from, to);
      CHECK(length <= grid * 1.0005);
      CHECK(length >= grid * 0.975);
    }
  }
}

TEST_CASE("between any two points the path is as short as the shortest path in the visibility graph") {
  for (const std::string& name : shipped_names()) {
    CAPTURE(name);
    const Gate gate = shipped_gate(name);
    const VisibilityGraph graph(gate);
    std::vector<dvec2> points = random_points(gate, 60, 7);
    for (const Slot& slot : slots(gate)) points.push_back(rest_position(gate, slot.gear));
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const dvec2 from = points[i], to = points[i + 1];
      CAPTURE(from.x);
      CAPTURE(from.y);
      CAPTURE(to.x);
      CAPTURE(to.y);
      const double length = shortest_path_length(gate, from, to), expected = graph.path_length(from, to);
      CHECK(length <= expected + 1e-6);
      CHECK(length >= expected - 1e-4);  // shortest_path() may pass up to 0.1 mm inside a wall
      CHECK(length >= glm::distance(from, to) - 1e-12);
      CHECK(length == doctest::Approx(shortest_path_length(gate, to, from)).epsilon(1e-9));
    }
  }
}

TEST_CASE("the path's points are its ends and at most four bends, and every leg is free") {
  for (const std::string& name : shipped_names()) {
    CAPTURE(name);
    const Gate gate = shipped_gate(name);
    const std::vector<dvec2> points = random_points(gate, 60, 11);
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const std::vector<dvec2> path = shortest_path(gate, points[i], points[i + 1]);
      REQUIRE(path.size() >= 2);
      CHECK(path.size() <= 6);
      CHECK(path.front() == points[i]);
      CHECK(path.back() == points[i + 1]);
      CHECK(length_of(path) == shortest_path_length(gate, points[i], points[i + 1]));
      for (std::size_t k = 1; k < path.size(); ++k) {
        CHECK(path[k] != path[k - 1]);
        for (double fraction = 0.0; fraction <= 1.0; fraction += 0.01)
          CHECK(in_free_space(gate, path[k - 1] + (path[k] - path[k - 1]) * fraction, 2e-4));
      }
    }
  }
}

TEST_CASE("a path of zero length is one point; around a wall its points are the wall's corners") {
  const Gate gate = paper_gate();
  CHECK(shortest_path(gate, {0.01, 0.0}, {0.01, 0.0}) == std::vector<dvec2>{{0.01, 0.0}});
  CHECK(shortest_path_length(gate, {0.01, 0.0}, {0.01, 0.0}) == 0.0);
  const std::vector<dvec2> path = shortest_path(gate, {-0.03, 0.03}, {0.0, 0.03});
  const std::vector<dvec2> corners{{-0.03, 0.03},   {-0.025, 0.01}, {-0.021, 0.006},
                                   {-0.009, 0.006}, {-0.005, 0.01}, {0.0, 0.03}};
  REQUIRE(path.size() == corners.size());
  for (std::size_t i = 0; i < path.size(); ++i) CHECK(glm::distance(path[i], corners[i]) < 1e-12);
  // A path that starts outside the gate is straight.
  CHECK(shortest_path(gate, {0.5, 0.5}, {0.0, 0.0}) == std::vector<dvec2>{{0.5, 0.5}, {0.0, 0.0}});
}
