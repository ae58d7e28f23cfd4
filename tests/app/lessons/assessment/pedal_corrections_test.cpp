// Small swings of pedals, compared with closed forms.
#include "app/lessons/assessment/pedal_corrections.h"

#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

using namespace gearshift::haptics;
using namespace gearshift::lessons;

namespace {

constexpr double kT = 0.001;  // [s]

// The rate [1/s] of a clutch pedal that follows `pedal` for 20 s.
template <class F>
std::optional<double> rate_of(F pedal, double period = kT) {
  PedalCorrections corrections;
  Pedals pedals;
  for (double t = 0.0; t < 20.0; t += period) {
    pedals.clutch = pedal(t);
    corrections.add(pedals, period);
  }
  return corrections.rate();
}

double sine(double t, double amplitude) {
  return 0.5 + amplitude * std::sin(2.0 * std::numbers::pi * t);
}

}  // namespace

TEST_CASE("a pedal that swings by +-a once a second travels 4 a per second; strokes and noise do not count") {
  for (const double period : {0.001, 0.00025, 0.01}) {
    CAPTURE(period);
    // The first and the last swing are not whole.
    CHECK(*rate_of([](double t) { return sine(t, 0.05); }, period) == doctest::Approx(0.2).epsilon(0.03));
    CHECK(*rate_of([](double t) { return sine(t, 0.02); }, period) == doctest::Approx(0.08).epsilon(0.03));
  }
  CHECK(*rate_of([](double t) { return sine(t, 0.1); }) == 0.0);    // swings of 20 %
  CHECK(*rate_of([](double t) { return sine(t, 0.004); }) == 0.0);  // a potentiometer's noise
  CHECK(*rate_of([](double t) { return 0.04 * t + 0.1; }) == 0.0);  // one steady stroke
}

TEST_CASE("a pedal at its ends tells nothing, and the three pedals share their time") {
  CHECK_FALSE(rate_of([](double) { return 0.0; }));
  CHECK_FALSE(rate_of([](double) { return 1.0; }));
  CHECK_FALSE(rate_of([](double t) { return t < 0.4 ? 0.5 : 1.0; }));
  CHECK_FALSE(rate_of([](double) { return std::nan(""); }));
  PedalCorrections corrections;
  for (double t = 0.0; t < 20.0; t += kT) corrections.add({0.5, 0.5, sine(t, 0.05), 0.0}, kT);
  CHECK(*corrections.rate() == doctest::Approx(0.2 / 3.0).epsilon(0.03));
}
