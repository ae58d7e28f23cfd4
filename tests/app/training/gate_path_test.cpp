// The shortest way through a gate against geometry by hand, and against a search over a fine grid.
#include "app/training/gate_path.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <random>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "tests/support/gates.h"

using namespace gearshift;
using glm::dvec2;

namespace {

// Dijkstra on a grid of 1 mm with moves to all cells within five: at most 2 % longer than the way itself.
double grid_way(const Gate& gate, dvec2 from, dvec2 to) {
  constexpr double kCell = 1e-3;
  constexpr int kReach = 5, kWide = 161, kHigh = 121;
  const auto cell = [](dvec2 p) {
    return std::pair<int, int>{static_cast<int>(std::lround(p.x / kCell)) + kWide / 2,
                               static_cast<int>(std::lround(p.y / kCell)) + kHigh / 2};
  };
  const auto place = [](int i, int j) { return dvec2{(i - kWide / 2) * kCell, (j - kHigh / 2) * kCell}; };
  std::vector<double> best(kWide * kHigh, 1e9);
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  const auto [i0, j0] = cell(from);
  const auto [i1, j1] = cell(to);
  best[static_cast<std::size_t>(j0 * kWide + i0)] = 0.0;
  open.emplace(0.0, j0 * kWide + i0);
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

}  // namespace

TEST_CASE("within a column the way is straight, round a wall it touches the corners") {
  const Gate gate = paper_gate();  // half aisle 6, chamfer 4, half slot 5, columns at -30, 0, 30 mm
  CHECK(shortest_way(gate, {0.0, 0.030}, {0.0, -0.030}) == doctest::Approx(0.060));
  CHECK(shortest_way(gate, {-0.03, 0.0}, {0.03, 0.0}) == doctest::Approx(0.060));
  // From (-30, 30) to (0, 30): over (-25, 10), (-21, 6), (-9, 6), (-5, 10).
  const double up = std::hypot(0.005, 0.020), round = std::hypot(0.004, 0.004);
  CHECK(shortest_way(gate, {-0.03, 0.03}, {0.0, 0.03}) == doctest::Approx(2 * up + 2 * round + 0.012).epsilon(1e-9));
}

TEST_CASE("the shortest way is as a search over a grid finds it, in every gate") {
  for (const std::string& name : {std::string("paper"), std::string("four_speed"), std::string("dog_leg_five")}) {
    CAPTURE(name);
    const Gate gate = shipped_gate(name);
    for (const Slot& a : slots(gate)) {
      const Slot& b = slot_of(gate, (static_cast<int>(&a - gate.slot.data()) + 3) % gate.slot_count);
      const auto rounded = [](dvec2 p) { return dvec2{std::round(1e3 * p.x) / 1e3, std::round(1e3 * p.y) / 1e3}; };
      const dvec2 from = rounded(rest_position(gate, a.gear)), to = rounded(rest_position(gate, b.gear));
      const double way = shortest_way(gate, from, to), grid = grid_way(gate, from, to);
      CHECK(way <= grid * 1.0005);
      CHECK(way >= grid * 0.975);
    }
  }
}

TEST_CASE("there is a way between any two points, not shorter than the straight line and the same both ways") {
  std::mt19937 random(7);
  for (const std::string& name : shipped_names()) {
    const Gate gate = shipped_gate(name);
    std::uniform_real_distribution<double> x(-0.07, 0.07), y(-0.05, 0.05);
    std::vector<dvec2> points;
    while (points.size() < 40) {
      const dvec2 p{x(random), y(random)};
      if (in_free_space(gate, p)) points.push_back(p);
    }
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const double way = shortest_way(gate, points[i], points[i + 1]);
      CHECK(way >= glm::distance(points[i], points[i + 1]) - 1e-12);
      CHECK(way < 0.3);
      CHECK(way == doctest::Approx(shortest_way(gate, points[i + 1], points[i])).epsilon(1e-9));
    }
  }
}
