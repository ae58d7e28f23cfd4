// Compares the low-pass filter that computes the jerk with its closed form.
#include "app/lessons/assessment/jerk_filter.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <doctest/doctest.h>

using namespace gearshift::lessons;

namespace {

constexpr double kOmega = 6.283185307179586 * kJerkCutoff;

double peak_of_step(double height, double period) {
  JerkFilter filter;
  filter.update(0.0, 0.0);
  double peak = 0.0;
  for (double t = 0.0; t < 0.2; t += period) peak = std::max(peak, filter.update(height, period));
  return peak;
}

}  // namespace

// If the acceleration steps by a0, the filter gives the jerk a0 sqrt(2) w exp(-s t) sin(s t), where w is the cut-off
// angular frequency and s = w / sqrt(2). Its maximum, at s t = pi / 4, is a0 w exp(-pi/4).
TEST_CASE("a step of acceleration gives the jerk of a second-order Butterworth low-pass") {
  const double expected = kOmega * std::exp(-0.25 * 3.14159265358979);
  CHECK(expected == doctest::Approx(42.97).epsilon(0.001));
  CHECK(kJerkPerStep == doctest::Approx(expected).epsilon(1e-12));
  CHECK(peak_of_step(1.0, 1e-5) == doctest::Approx(expected).epsilon(1e-6));
  CHECK(peak_of_step(2.0, 1e-5) == doctest::Approx(2.0 * expected).epsilon(1e-6));
  CHECK(peak_of_step(1.0, 1e-3) == doctest::Approx(expected).epsilon(0.002));
}

TEST_CASE("the response to a constant input does not depend on the sample period") {
  JerkFilter fine, coarse;
  fine.update(0.0, 0.0);
  coarse.update(0.0, 0.0);
  for (int i = 0; i < 10; ++i) {
    for (int k = 0; k < 11; ++k) fine.update(3.0, 0.001);
    coarse.update(3.0, 0.011);
    CHECK(fine.jerk() == doctest::Approx(coarse.jerk()).epsilon(1e-9));
  }
}

TEST_CASE("the jerk of a ramp is its slope, and that of a sine well below the cut-off its derivative") {
  JerkFilter ramp, sine;
  double peak = 0.0;
  for (int i = 0; i < 5000; ++i) {
    const double t = 1e-3 * i;
    ramp.update(7.0 * t, 1e-3);
    sine.update(std::sin(6.283185307179586 * t), 1e-3);  // a sine of 1 Hz
    if (t > 1.0) peak = std::max(peak, std::abs(sine.jerk()));
  }
  CHECK(ramp.jerk() == doctest::Approx(7.0).epsilon(0.001));
  CHECK(peak == doctest::Approx(6.283185).epsilon(0.001));
}

TEST_CASE("after the settling time less than 0.3 % of a step's response is left") {
  JerkFilter filter;
  filter.update(0.0, 0.0);
  for (int i = 0; i < 100; ++i) filter.update(1.0, 1e-3);
  CHECK(std::abs(filter.jerk()) < 0.003 * 42.97);
}

TEST_CASE("an invalid acceleration or period is skipped and has no later effect") {
  for (const double none : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    JerkFilter clean, poisoned;
    poisoned.update(none, 0.0);  // an invalid sample must not initialise the filter
    for (int i = 0; i < 100; ++i) {
      const double a = i < 50 ? 0.0 : 3.0;
      clean.update(a, 1e-3);
      if (i == 20) CHECK(poisoned.update(none, 1e-3) == 0.0);
      if (i == 70) CHECK(poisoned.update(a, none) == poisoned.jerk());
      poisoned.update(a, 1e-3);
      CHECK(poisoned.jerk() == clean.jerk());
    }
  }
}
