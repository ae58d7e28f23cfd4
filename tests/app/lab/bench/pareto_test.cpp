// Tests with small sets of points whose Pareto front is obvious.
#include "app/lab/bench/pareto.h"

#include <limits>

#include <doctest/doctest.h>

using namespace gearshift::lab;

namespace {

using Front = std::vector<std::size_t>;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TEST_CASE("the front of a known set, cheapest first") {
  // index:                          0       1       2       3       4       5
  const std::vector<glm::dvec2> set{{9, 1}, {1, 9}, {4, 4}, {5, 5}, {4, 8}, {2, 9.5}};
  CHECK(pareto_front(set) == Front{1, 2, 0});
}

TEST_CASE("equal points stay together; a point that ties in one coordinate and loses in the other is beaten") {
  CHECK(pareto_front({{2, 2}, {2, 2}, {2, 3}, {3, 2}}) == Front{0, 1});
}

TEST_CASE("a single point is the front, an empty set has none, and NaN is never on it") {
  CHECK(pareto_front({{7, 7}}) == Front{0});
  CHECK(pareto_front({}) == Front{});
  CHECK(pareto_front({{kNone, 0}, {0, kNone}, {3, 3}, {1, std::numeric_limits<double>::infinity()}}) == Front{2});
}

TEST_CASE("zero cost is the best possible") {
  CHECK(pareto_front({{0, 5}, {1, 5}, {1, 0}, {2, 0}}) == Front{0, 2});
}
