// The jerk's low-pass against its closed form.
#include "app/training/jerk_filter.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <doctest/doctest.h>

using namespace gearshift;

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

// y' of a step of a0: a0 sqrt(2) w exp(-s t) sin(s t), s = w / sqrt(2): at its highest, s t = pi / 4, a0 w exp(-pi/4).
TEST_CASE("a step of acceleration gives the jerk of a second-order Butterworth low-pass") {
  const double expected = kOmega * std::exp(-0.25 * 3.14159265358979);
  CHECK(expected == doctest::Approx(42.97).epsilon(0.001));
  CHECK(kJerkOfStep == doctest::Approx(expected).epsilon(1e-12));
  CHECK(peak_of_step(1.0, 1e-5) == doctest::Approx(expected).epsilon(1e-6));
  CHECK(peak_of_step(2.0, 1e-5) == doctest::Approx(2.0 * expected).epsilon(1e-6));
  CHECK(peak_of_step(1.0, 1e-3) == doctest::Approx(expected).epsilon(0.002));
}

TEST_CASE("the answer to what is held does not depend on the period") {
  JerkFilter fine, coarse;
  fine.update(0.0, 0.0);
  coarse.update(0.0, 0.0);
  for (int i = 0; i < 10; ++i) {
    for (int k = 0; k < 11; ++k) fine.update(3.0, 0.001);
    coarse.update(3.0, 0.011);
    CHECK(fine.jerk() == doctest::Approx(coarse.jerk()).epsilon(1e-9));
  }
}

TEST_CASE("a steady rise is its own jerk, a sine well below the cut-off too") {
  JerkFilter ramp, sine;
  double peak = 0.0;
  for (int i = 0; i < 5000; ++i) {
    const double t = 1e-3 * i;
    ramp.update(7.0 * t, 1e-3);
    sine.update(std::sin(6.283185307179586 * t), 1e-3);  // 1 Hz
    if (t > 1.0) peak = std::max(peak, std::abs(sine.jerk()));
  }
  CHECK(ramp.jerk() == doctest::Approx(7.0).epsilon(0.001));
  CHECK(peak == doctest::Approx(6.283185).epsilon(0.001));
}

TEST_CASE("what is left after the settling time is a thousandth") {
  JerkFilter filter;
  filter.update(0.0, 0.0);
  for (int i = 0; i < 100; ++i) filter.update(1.0, 1e-3);
  CHECK(std::abs(filter.jerk()) < 0.003 * 42.97);
}

TEST_CASE("an acceleration that is no number, or a period, is left out and spoils nothing after it") {
  for (const double none : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    JerkFilter clean, spoilt;
    spoilt.update(none, 0.0);  // nor does it fill the filter
    for (int i = 0; i < 100; ++i) {
      const double a = i < 50 ? 0.0 : 3.0;
      clean.update(a, 1e-3);
      if (i == 20) CHECK(spoilt.update(none, 1e-3) == 0.0);
      if (i == 70) CHECK(spoilt.update(a, none) == spoilt.jerk());
      spoilt.update(a, 1e-3);
      CHECK(spoilt.jerk() == clean.jerk());
    }
  }
}
