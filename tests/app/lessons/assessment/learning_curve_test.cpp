#include "app/lessons/assessment/learning_curve.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include <doctest/doctest.h>

using namespace gearshift::lessons;

namespace {

std::vector<double> drawn(double level, double gain, double trials, int count, double noise, unsigned seed) {
  std::mt19937 chance(seed);
  std::normal_distribution<double> off(0.0, 1.0);
  std::vector<double> grades;
  for (int n = 0; n < count; ++n) grades.push_back(level + gain * std::exp(-n / trials) + noise * off(chance));
  return grades;
}

constexpr LevelBounds kScale{0.0, 10.0};
constexpr double kLevelStep = 0.02, kTrialsRatio = 1.01;  // grid: step between levels, ratio between numbers of trials

struct Point {
  double level = 0.0, gain = 0.0, trials = 0.0, square = HUGE_VAL;
};

// The grid point for this level and number of trials, with the gain that minimises the sum of squares. Computed by
// plain summation.
Point point_at(const std::vector<double>& grades, double level, double trials) {
  double cross = 0.0, square_sum = 0.0;
  for (std::size_t n = 0; n < grades.size(); ++n) {
    const double decay = std::exp(-static_cast<double>(n) / trials);
    cross += decay * (grades[n] - level);
    square_sum += decay * decay;
  }
  Point point{level, cross / square_sum, trials, 0.0};
  for (std::size_t n = 0; n < grades.size(); ++n) {
    const double off = grades[n] - level - point.gain * std::exp(-static_cast<double>(n) / trials);
    point.square += off * off;
  }
  return point;
}

// The grid point with the smallest sum of squares, over all levels of the scale and all numbers of trials.
Point best_of_grid(const std::vector<double>& grades) {
  Point best;
  for (double trials = 0.3; trials <= 10.0 * static_cast<double>(grades.size()); trials *= kTrialsRatio) {
    for (int i = 0; i * kLevelStep <= kScale.highest + 1e-9; ++i) {
      const Point point = point_at(grades, i * kLevelStep, trials);
      if (point.square < best.square) best = point;
    }
  }
  return best;
}

std::vector<double> on_the_scale(std::vector<double> grades) {
  for (double& grade : grades) grade = std::clamp(grade, kScale.lowest, kScale.highest);
  return grades;
}

}  // namespace

TEST_CASE("a fit to grades that follow the law finds its three parameters") {
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

// A 95 % interval contains the true value in 95 % of all draws. In 500 draws that is 475 times, with a standard
// deviation of 5 (binomial distribution). The fit is nonlinear, so its fraction deviates a little. The test allows 92 %
// to 98 %.
TEST_CASE("the stated deviations contain the truth in the stated fraction of fits") {
  int held[3] = {0, 0, 0}, fits = 0;
  constexpr int kDraws = 500;
  for (unsigned seed = 0; seed < kDraws; ++seed) {
    const auto curve = fit_learning_curve(drawn(8.0, -5.0, 5.0, 40, 0.5, seed));
    if (!curve) continue;
    ++fits;
    const double truth[3] = {8.0, -5.0, 5.0};
    const Estimate estimates[3] = {curve->level, curve->gain, curve->trials};
    for (int i = 0; i < 3; ++i) held[i] += std::abs(estimates[i].value - truth[i]) < 1.96 * estimates[i].deviation;
  }
  CHECK(fits >= kDraws - 5);
  for (const int count : held) {
    CHECK(count > 0.92 * fits);
    CHECK(count < 0.98 * fits);
  }
}

TEST_CASE("no curve is fitted to too few trials, grades without a bend, or constant grades") {
  CHECK_FALSE(fit_learning_curve(drawn(8.0, -5.0, 2.0, 4, 0.0, 1)).has_value());
  std::vector<double> straight, same(12, 6.0);
  for (int n = 0; n < 12; ++n) straight.push_back(2.0 + 0.5 * n);
  CHECK_FALSE(fit_learning_curve(straight).has_value());
  CHECK_FALSE(fit_learning_curve(same).has_value());
}

TEST_CASE("a level inside its bounds is fitted as without bounds") {
  const std::vector<double> grades = drawn(8.0, -5.0, 4.0, 20, 0.3, 3);
  const auto free = fit_learning_curve(grades), bounded = fit_learning_curve(grades, kScale);
  REQUIRE(free.has_value());
  REQUIRE(bounded.has_value());
  CHECK_FALSE(bounded->at_bound);
  CHECK(bounded->level.value == free->level.value);
  CHECK(bounded->level.deviation == free->level.deviation);
  CHECK(bounded->trials.value == free->trials.value);
}

// The simulated grades are still rising or falling at the last trial.
TEST_CASE("the bounded fit is at least as good as the best grid point on the scale") {
  int at_bound = 0, inside = 0, beyond = 0;
  for (const bool rises : {true, false}) {
    for (unsigned seed = 0; seed < 12; ++seed) {
      CAPTURE(rises);
      CAPTURE(seed);
      const std::vector<double> grades =
          on_the_scale(rises ? drawn(11.0, -8.0, 9.0, 16, 0.6, seed) : drawn(-1.0, 9.0, 9.0, 16, 0.6, seed));
      const auto free = fit_learning_curve(grades), curve = fit_learning_curve(grades, kScale);
      if (!curve) continue;
      REQUIRE(free.has_value());
      beyond += free->level.value > kScale.highest || free->level.value < kScale.lowest;
      const Point best = best_of_grid(grades);
      const double square = curve->noise * curve->noise * (16.0 - (curve->at_bound ? 2.0 : 3.0));
      CHECK(square <= best.square * (1.0 + 1e-9));
      CHECK(square == doctest::Approx(best.square).epsilon(1e-3));
      CHECK(curve->level.value <= kScale.highest);
      CHECK(curve->level.value >= kScale.lowest);
      CHECK(curve->at_bound == (curve->level.value == kScale.highest || curve->level.value == kScale.lowest));
      if (curve->at_bound) {
        CHECK(curve->level.value == doctest::Approx(best.level));
        CHECK(curve->trials.value == doctest::Approx(best.trials).epsilon(kTrialsRatio - 1.0));
        CHECK(curve->gain.value == doctest::Approx(best.gain).epsilon(5e-3));
      }
      (curve->at_bound ? at_bound : inside) += 1;
    }
  }
  CHECK(at_bound >= 8);  // the seeds produced both cases: fits at a bound, and fits inside
  CHECK(inside >= 3);
  CHECK(beyond >= at_bound / 2);  // without bounds, many fits leave the scale, so the bounds are needed
}

// The expected deviations are computed independently, from finite differences of the curve and a 2 x 2 matrix that is
// inverted by hand.
TEST_CASE("at a bound the level has no deviation, and those of gain and trials are computed with the level fixed") {
  std::optional<LearningCurve> curve;
  for (unsigned seed = 0; !curve || !curve->at_bound; ++seed) {
    REQUIRE(seed < 50);
    curve = fit_learning_curve(on_the_scale(drawn(11.0, -8.0, 9.0, 16, 0.6, seed)), kScale);
  }
  double gain_gain = 0.0, gain_trials = 0.0, trials_trials = 0.0;
  for (int n = 0; n < 16; ++n) {
    const auto moved = [&](double gain, double trials) {
      LearningCurve other = *curve;
      other.gain.value += gain;
      other.trials.value += trials;
      return other.at(n);
    };
    const double by_gain = (moved(1e-4, 0.0) - moved(-1e-4, 0.0)) / 2e-4;
    const double by_trials = (moved(0.0, 1e-4) - moved(0.0, -1e-4)) / 2e-4;
    gain_gain += by_gain * by_gain;
    gain_trials += by_gain * by_trials;
    trials_trials += by_trials * by_trials;
  }
  const double determinant = gain_gain * trials_trials - gain_trials * gain_trials;
  CHECK(curve->level.deviation == 0.0);
  CHECK(curve->gain.deviation == doctest::Approx(curve->noise * std::sqrt(trials_trials / determinant)).epsilon(1e-5));
  CHECK(curve->trials.deviation == doctest::Approx(curve->noise * std::sqrt(gain_gain / determinant)).epsilon(1e-5));
}

TEST_CASE("a bound creates no bend: grades on a straight line still give no curve") {
  std::vector<double> straight;
  for (int n = 0; n < 12; ++n) straight.push_back(2.0 + 0.5 * n);
  CHECK_FALSE(fit_learning_curve(straight, kScale).has_value());
}
