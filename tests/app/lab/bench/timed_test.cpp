#include <doctest/doctest.h>

#include "app/lab/bench/rows/bench.h"

using namespace gearshift::lab;

// Quantiles follow definition 7 of Hyndman and Fan (1996), the default in R: linear interpolation between samples.
TEST_CASE("quantiles of few samples are interpolated, not rounded to a sample") {
  std::vector<double> two{3.0, 1.0}, four{4.0, 1.0, 3.0, 2.0}, one{5.0};
  CHECK(timed(two).median == doctest::Approx(2.0));
  const Timed of_four = timed(four);
  CHECK(of_four.median == doctest::Approx(2.5));
  REQUIRE(of_four.spread);
  CHECK(of_four.spread->low == doctest::Approx(1.75));
  CHECK(of_four.spread->high == doctest::Approx(3.25));
  CHECK(timed(one).median == 5.0);
  CHECK_FALSE(timed(one).spread);
  CHECK(quantile(four, 1.0) == 4.0);
}
