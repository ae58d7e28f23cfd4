// Tests of the positions of numbers on a logarithmic axis.
#include "app/lab/bench/log_axis.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <doctest/doctest.h>

using namespace gearshift::lab;
using doctest::Approx;

TEST_CASE("equal ratios have equal distances, and all values are inside") {
  const LogAxis axis({3.0, 40.0, 700.0});
  CHECK(axis.fraction(40.0) - axis.fraction(4.0) == Approx(axis.fraction(400.0) - axis.fraction(40.0)));
  CHECK(axis.fraction(3.0) > 0.0);
  CHECK(axis.fraction(700.0) < 1.0);
  CHECK(axis.fraction(3.0) == Approx(1.0 - axis.fraction(700.0)));
}

TEST_CASE("zero is at the start of the axis, at least a decade before the smallest positive value") {
  const LogAxis axis({0.0, 10.0, 1000.0});
  CHECK(axis.begins_with_zero());
  CHECK(axis.fraction(0.0) == 0.0);
  CHECK(axis.fraction(10.0) > axis.fraction(1000.0) - axis.fraction(100.0));
  CHECK_FALSE(LogAxis({10.0, 1000.0}).begins_with_zero());
}

TEST_CASE("every axis has labels, none outside, and few enough over many decades") {
  for (const std::vector<double>& figures : {std::vector<double>{5.0},
                                             {38.0, 83.0},
                                             {1e-16, 1e-2},
                                             {},
                                             {0.0},
                                             {0.0, std::numeric_limits<double>::quiet_NaN(), 2.0}}) {
    const LogAxis axis(figures);
    int named = 0;
    for (const LogAxis::Tick& tick : axis.ticks()) {
      CHECK(axis.fraction(tick.value) >= 0.0);
      CHECK(axis.fraction(tick.value) <= 1.0);
      named += tick.named ? 1 : 0;
    }
    CHECK(named >= 1);
    CHECK(named <= 9);
  }
}
