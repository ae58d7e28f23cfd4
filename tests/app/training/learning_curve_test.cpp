#include "app/training/learning_curve.h"

#include <cmath>
#include <random>
#include <vector>

#include <doctest/doctest.h>

using namespace gearshift;

namespace {

std::vector<double> drawn(double level, double gain, double trials, int count, double noise, unsigned seed) {
  std::mt19937 chance(seed);
  std::normal_distribution<double> off(0.0, 1.0);
  std::vector<double> grades;
  for (int n = 0; n < count; ++n) grades.push_back(level + gain * std::exp(-n / trials) + noise * off(chance));
  return grades;
}

}  // namespace

TEST_CASE("grades that follow the law give its three numbers back") {
  for (const double trials : {1.0, 4.0, 20.0}) {
    for (const double gain : {-6.0, 3.0}) {
      const auto curve = fit_learning_curve(drawn(8.0, gain, trials, 30, 0.0, 1));
      REQUIRE(curve.has_value());
      CHECK(curve->level.value == doctest::Approx(8.0).epsilon(1e-6));
      CHECK(curve->gain.value == doctest::Approx(gain).epsilon(1e-6));
      CHECK(curve->trials.value == doctest::Approx(trials).epsilon(1e-6));
      CHECK(curve->noise < 1e-6);
      CHECK(curve->at(3.0) == doctest::Approx(8.0 + gain * std::exp(-3.0 / trials)).epsilon(1e-6));
    }
  }
}

// A 95 % interval holds the truth in 95 of 100 draws: of 500, 475 +- 5 by the binomial law; a fit that is not linear is
// a little off.
TEST_CASE("the stated deviations hold the truth as often as they should") {
  int held[3] = {0, 0, 0}, fits = 0;
  constexpr int kDraws = 500;
  for (unsigned seed = 0; seed < kDraws; ++seed) {
    const auto curve = fit_learning_curve(drawn(8.0, -5.0, 5.0, 40, 0.5, seed));
    if (!curve) continue;
    ++fits;
    const double truth[3] = {8.0, -5.0, 5.0};
    const Estimate seen[3] = {curve->level, curve->gain, curve->trials};
    for (int i = 0; i < 3; ++i) held[i] += std::abs(seen[i].value - truth[i]) < 1.96 * seen[i].deviation;
  }
  CHECK(fits >= kDraws - 5);
  for (const int count : held) {
    CHECK(count > 0.92 * fits);
    CHECK(count < 0.98 * fits);
  }
}

TEST_CASE("nothing is claimed of too few trials, of grades without a bend, or of one grade over and over") {
  CHECK_FALSE(fit_learning_curve(drawn(8.0, -5.0, 2.0, 4, 0.0, 1)).has_value());
  std::vector<double> straight, same(12, 6.0);
  for (int n = 0; n < 12; ++n) straight.push_back(2.0 + 0.5 * n);
  CHECK_FALSE(fit_learning_curve(straight).has_value());
  CHECK_FALSE(fit_learning_curve(same).has_value());
}
