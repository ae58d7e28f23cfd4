// Tests of the positions and numbers of plot axes.
#include "app/base/chart.h"

#include <limits>
#include <string>

#include <doctest/doctest.h>

using namespace gearshift::base;
using doctest::Approx;

namespace {

constexpr Rect kBox{100.0, 50.0, 400.0, 200.0};

// Draws with Chart(svg, kBox, x, y) and returns the SVG.
template <class Draw>
std::string drawn(const Scale& x, const Scale& y, const Draw& draw) {
  Svg svg({0.0, 0.0, 600.0, 300.0}, 1.0);
  draw(Chart(svg, kBox, x, y));
  return std::move(svg).finish();
}

bool has(const std::string& svg, std::string_view text) {
  return svg.find(text) != std::string::npos;
}

}  // namespace

TEST_CASE("a linear axis: its ends are the box's, with numbers at multiples of the step") {
  const Scale scale(-10.0, 30.0);
  CHECK(scale.fraction(-10.0) == 0.0);
  CHECK(scale.fraction(30.0) == 1.0);
  CHECK(scale.fraction(0.0) == Approx(0.25));
  std::vector<double> values;
  for (const Scale::Tick& tick : scale.ticks(20.0, 0.0)) values.push_back(tick.value);
  CHECK(values == std::vector<double>{0.0, 20.0});
}

TEST_CASE("a chart writes its numbers with a minus sign and in groups") {
  const std::string svg = drawn({0.0, 40000.0}, {-5.0, 5.0}, [](const Chart& chart) {
    chart.x_grid(20000.0);
    chart.y_grid(5.0);
    CHECK(chart.at(0.0, -5.0) == glm::dvec2(100.0, 250.0));
    CHECK(chart.at(40000.0, 5.0) == glm::dvec2(500.0, 50.0));
  });
  for (const char* number : {">0</text>", ">20 000</text>", ">40 000</text>", ">−5</text>", ">5</text>"})
    CHECK(has(svg, number));
}

TEST_CASE("a curve is cut off outside the box") {
  const std::string svg = drawn({0.0, 1.0}, {0.0, 1.0}, [](const Chart& chart) {
    chart.curve({{0.0, 0.5}, {1.0, 9.0}}, {"#000000", 2.0});
  });
  CHECK(has(svg, "width=\"402.000\" height=\"202.000\" style=\"width:402.000px;height:202.000px\""));
}

// From 1000 to 0, nine tenths of the way are at 100, the middle of the axis.
TEST_CASE("a straight line of the data is curved on a logarithmic axis") {
  const std::string svg = drawn({0.0, 1.0}, Scale::decades(10.0, 1000.0), [](const Chart& chart) {
    chart.curve({{0.0, 1000.0}, {1.0, 0.0}}, {"#000000", 2.0});
  });
  CHECK(has(svg, "460.000,150.000"));
}

TEST_CASE("logarithmic axis: equal ratios have equal distances, and all values are inside") {
  const Scale axis = Scale::decades_around({3.0, 40.0, 700.0});
  CHECK(axis.fraction(40.0) - axis.fraction(4.0) == Approx(axis.fraction(400.0) - axis.fraction(40.0)));
  CHECK(axis.fraction(3.0) > 0.0);
  CHECK(axis.fraction(700.0) < 1.0);
  CHECK(axis.fraction(3.0) == Approx(1.0 - axis.fraction(700.0)));
}

TEST_CASE("logarithmic axis: zero is at the start, at least a decade before the smallest positive value") {
  const Scale axis = Scale::decades_around({0.0, 10.0, 1000.0});
  CHECK(axis.ticks(0.0, 9.0).front().value == 0.0);
  CHECK(axis.fraction(0.0) == 0.0);
  CHECK(axis.fraction(10.0) > axis.fraction(1000.0) - axis.fraction(100.0));
  CHECK(Scale::decades_around({10.0, 1000.0}).ticks(0.0, 9.0).front().value > 0.0);
}

TEST_CASE("logarithmic axis: what has no place is below the start, and infinity is at the end") {
  const Scale axis = Scale::decades(10.0, 1000.0);
  CHECK(axis.fraction(100.0) == Approx(0.5));
  CHECK(axis.fraction(0.0) == -1.0);
  CHECK(axis.fraction(std::numeric_limits<double>::infinity()) == 1.0);
}

TEST_CASE("logarithmic axis: always has numbers, none outside, and few enough over many decades") {
  for (const std::vector<double>& figures : {std::vector<double>{5.0},
                                             {38.0, 83.0},
                                             {1e-16, 1e-2},
                                             {},
                                             {0.0},
                                             {0.0, std::numeric_limits<double>::quiet_NaN(), 2.0}}) {
    const Scale axis = Scale::decades_around(figures);
    int named = 0;
    for (const Scale::Tick& tick : axis.ticks(0.0, 9.0)) {
      CHECK(axis.fraction(tick.value) >= 0.0);
      CHECK(axis.fraction(tick.value) <= 1.0);
      named += tick.named ? 1 : 0;
    }
    CHECK(named >= 1);
    CHECK(named <= 10);
  }
}
