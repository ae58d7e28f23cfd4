// Tests that the confidence band contains the true learning curve in the stated fraction of fits.
#include "app/lessons/report/curve_band.h"

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <doctest/doctest.h>

using namespace gearshift::lessons;

namespace {

// The true curve: grade(n) = level + gain exp(-n / trials).
constexpr double kLevel = 8.0, kGain = -5.0, kTrials = 4.0;
constexpr std::size_t kCount = 20;

double truth(double n) {
  return kLevel + kGain * std::exp(-n / kTrials);
}

std::optional<LearningCurve> fit_to(std::mt19937& chance, double noise) {
  std::normal_distribution<double> scatter(0.0, noise);
  std::vector<double> grades;
  for (std::size_t i = 0; i < kCount; ++i) grades.push_back(truth(static_cast<double>(i)) + scatter(chance));
  return fit_learning_curve(grades);
}

}  // namespace

TEST_CASE("after many trials the curve is as uncertain as its level") {
  std::mt19937 chance(1);
  const auto curve = fit_to(chance, 0.3);
  REQUIRE(curve.has_value());
  CHECK(curve_deviation(*curve, kCount, 1e4) == doctest::Approx(curve->level.deviation).epsilon(1e-6));
}

// If many learning curves are fitted to noisy grades of one true curve, about 95 % of the fits are within two
// deviations of the true curve at each trial. Student's t with 17 degrees of freedom (20 grades minus 3 parameters)
// predicts 93.8 %; the test accepts 91 to 97 %.
TEST_CASE("two deviations contain the true curve in about 95 of 100 fits") {
  std::mt19937 chance(2);
  const std::array<double, 4> places{0.0, 3.0, 8.0, 19.0};
  std::array<int, 4> within{}, within_half{};
  int fits = 0;
  for (int round = 0; round < 1000; ++round) {
    const auto curve = fit_to(chance, 0.3);
    if (!curve) continue;
    ++fits;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double off = std::abs(curve->at(places[i]) - truth(places[i]));
      const double deviation = curve_deviation(*curve, kCount, places[i]);
      if (off <= 2.0 * deviation) ++within[i];
      if (off <= 1.0 * deviation) ++within_half[i];
    }
  }
  CHECK(fits > 950);
  for (std::size_t i = 0; i < places.size(); ++i) {
    CAPTURE(places[i]);
    CHECK(within[i] > 0.91 * fits);
    CHECK(within[i] < 0.97 * fits);
    CHECK(within_half[i] <
          0.72 * fits);  // cross-check: a band of half the width should contain the curve in 67 % of fits
    CHECK(within_half[i] > 0.60 * fits);
  }
}

TEST_CASE(
    "a level at its bound is certain, so the first trial is as uncertain as the gain, and later trials are certain") {
  std::vector<double> grades;  // the grades tend to 11, above the bound of 10, with a scatter of +- 0.2
  for (int n = 0; n < 12; ++n) grades.push_back(11.0 - 8.0 * std::exp(-n / 8.0) + (n % 2 == 0 ? 0.2 : -0.2));
  const auto curve = fit_learning_curve(grades, {0.0, 10.0});
  REQUIRE(curve.has_value());
  REQUIRE(curve->at_bound);
  CHECK(curve_deviation(*curve, 12, 0.0) == doctest::Approx(curve->gain.deviation).epsilon(1e-6));
  CHECK(curve_deviation(*curve, 12, 1e4) < 1e-9);
}
