#include "app/lessons/assessment/learning_curve.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numeric>
#include <vector>

#include <glm/mat2x2.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

namespace gearshift::lessons {
namespace {

constexpr std::size_t kMinTrials = 5;
constexpr double kFastest = 0.3;   // [1] shortest time constant, in trials: 4 % of the gain is left at the second trial
constexpr double kSlowest = 10.0;  // [1] longest time constant, relative to the number of trials
constexpr int kGrid = 200;
constexpr double kNoGain = 1e-6;         // [1] rounding
constexpr double kNarrowEnough = 1e-10;  // [1] relative

struct LinearFit {
  double level = 0.0, gain = 0.0;
  double square = 0.0;  // sum of squared residuals
  bool at_bound = false;
};

double mean(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

// Sum of (a - a_offset) (b - b_offset) over all elements.
double products(std::span<const double> a, double a_offset, std::span<const double> b, double b_offset) {
  return std::transform_reduce(a.begin(), a.end(), b.begin(), 0.0, std::plus<>(),
                               [&](double x, double y) { return (x - a_offset) * (y - b_offset); });
}

// For a fixed time constant the fit is linear (variable projection), and its squared error is convex in the level. So
// if the best level is out of bounds, the nearer bound is the best allowed level; the gain is then fitted for this
// level.
LinearFit fit_for(std::span<const double> grades, double trials, const LevelBounds& bounds) {
  std::vector<double> decay(grades.size());
  for (std::size_t n = 0; n < decay.size(); ++n) decay[n] = std::exp(-static_cast<double>(n) / trials);
  const double middle = mean(decay), grade = mean(grades);
  LinearFit fit;
  fit.gain = products(decay, middle, grades, grade) / products(decay, middle, decay, middle);
  fit.level = grade - fit.gain * middle;
  fit.at_bound = fit.level < bounds.lowest || fit.level > bounds.highest;
  if (fit.at_bound) {
    fit.level = std::clamp(fit.level, bounds.lowest, bounds.highest);
    fit.gain = products(decay, 0.0, grades, fit.level) / products(decay, 0.0, decay, 0.0);
  }
  for (std::size_t n = 0; n < decay.size(); ++n) {
    const double residual = fit.level + fit.gain * decay[n] - grades[n];
    fit.square += residual * residual;
  }
  return fit;
}

// Golden-section search for the best log(trials) between `low` and `high`, the neighbours of the best grid point.
double refine_trials(std::span<const double> grades, const LevelBounds& bounds, double low, double high) {
  const double golden = (std::sqrt(5.0) - 1.0) / 2.0;
  const auto cost = [&](double x) { return fit_for(grades, std::exp(x), bounds).square; };
  double a = high - golden * (high - low), b = low + golden * (high - low);
  double at_a = cost(a), at_b = cost(b);
  while (high - low > kNarrowEnough) {
    if (at_a < at_b) {
      high = b, b = a, at_b = at_a;
      at_a = cost(a = high - golden * (high - low));
    } else {
      low = a, a = b, at_a = at_b;
      at_b = cost(b = low + golden * (high - low));
    }
  }
  return (low + high) / 2.0;
}

// Returns the time constant with the smallest squared error, in trials; empty if the best one lies at an end of the
// grid.
std::optional<double> best_trials(std::span<const double> grades, const LevelBounds& bounds) {
  const double fastest = std::log(kFastest), slowest = std::log(kSlowest * static_cast<double>(grades.size()));
  const double step = (slowest - fastest) / kGrid;
  int best = 0;
  double min_square = HUGE_VAL;
  for (int i = 0; i <= kGrid; ++i) {
    const double square = fit_for(grades, std::exp(fastest + step * i), bounds).square;
    if (square < min_square) min_square = square, best = i;
  }
  if (best == 0 || best == kGrid) return std::nullopt;
  return std::exp(refine_trials(grades, bounds, fastest + step * (best - 1), fastest + step * (best + 1)));
}

// Variances of level, gain and trials: the diagonal of noise^2 (J^T J)^-1, where J is the Jacobian of the curve. A
// level fixed at its bound has variance 0.
glm::dvec3 variances(const LearningCurve& curve, std::size_t count) {
  glm::dmat3 information(0.0);
  const double trials = curve.trials.value;
  for (std::size_t i = 0; i < count; ++i) {
    const double n = static_cast<double>(i), decay = std::exp(-n / trials);
    const glm::dvec3 slope(1.0, decay, curve.gain.value * decay * n / (trials * trials));
    information += glm::outerProduct(slope, slope);
  }
  const double square = curve.noise * curve.noise;
  if (curve.at_bound) {
    const glm::dmat2 free =
        glm::inverse(glm::dmat2(information[1][1], information[1][2], information[2][1], information[2][2]));
    return square * glm::dvec3(0.0, free[0][0], free[1][1]);
  }
  const glm::dmat3 spread = glm::inverse(information);
  return square * glm::dvec3(spread[0][0], spread[1][1], spread[2][2]);
}

}  // namespace

double LearningCurve::at(double n) const noexcept {
  return level.value + gain.value * std::exp(-n / trials.value);
}

std::optional<LearningCurve> fit_learning_curve(std::span<const double> grades, const LevelBounds& bounds) {
  if (grades.size() < kMinTrials) return std::nullopt;
  // With bounds, even grades on a straight line can fit a curve. So a curve must be found without bounds, too.
  if (!best_trials(grades, {})) return std::nullopt;
  const std::optional<double> trials = best_trials(grades, bounds);
  if (!trials) return std::nullopt;
  const LinearFit fit = fit_for(grades, *trials, bounds);
  LearningCurve curve{{fit.level}, {fit.gain}, {*trials}};
  curve.at_bound = fit.at_bound;
  const double free = fit.at_bound ? 2.0 : 3.0;
  curve.noise = std::sqrt(fit.square / (static_cast<double>(grades.size()) - free));
  const glm::dvec3 variance = variances(curve, grades.size());
  if (!std::isfinite(variance.x + variance.y + variance.z)) return std::nullopt;
  curve.level.deviation = std::sqrt(std::max(0.0, variance.x));
  curve.gain.deviation = std::sqrt(std::max(0.0, variance.y));
  curve.trials.deviation = std::sqrt(std::max(0.0, variance.z));
  if (std::abs(curve.gain.value) <= 2.0 * curve.gain.deviation + kNoGain) return std::nullopt;
  return curve;
}

}  // namespace gearshift::lessons
