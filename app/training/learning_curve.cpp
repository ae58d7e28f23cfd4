#include "app/training/learning_curve.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>

namespace gearshift {
namespace {

constexpr std::size_t kLeastTrials = 5;
constexpr double kFastest = 0.3;   // [1] trials: the second one is within 4 % of the level
constexpr double kSlowest = 10.0;  // [1] of the trials that there are
constexpr int kGrid = 200;
constexpr double kNoGain = 1e-6;         // [1] rounding
constexpr double kNarrowEnough = 1e-10;  // [1] relative

using Pair = Eigen::Vector2d;

struct LinearFit {
  Pair level_and_gain;
  double square = 0.0;  // sum of squared residuals
  bool at_bound = false;
};

// For one rate the rest is linear (variable projection), and the squares are convex in the level: where the best one is
// out of bounds, the best within is the nearer bound, with the gain that suits it.
LinearFit fit_for(std::span<const double> grades, double trials, const LevelBounds& bounds) {
  const auto count = static_cast<Eigen::Index>(grades.size());
  Eigen::MatrixX2d shape(count, 2);
  for (Eigen::Index n = 0; n < count; ++n) shape.row(n) << 1.0, std::exp(-static_cast<double>(n) / trials);
  const Eigen::Map<const Eigen::VectorXd> seen(grades.data(), count);
  Pair found = shape.householderQr().solve(seen);
  const bool at_bound = found[0] < bounds.lowest || found[0] > bounds.highest;
  if (at_bound) {
    const auto decay = shape.col(1);
    found[0] = std::clamp(found[0], bounds.lowest, bounds.highest);
    found[1] = decay.dot(seen - found[0] * shape.col(0)) / decay.squaredNorm();
  }
  return {found, (shape * found - seen).squaredNorm(), at_bound};
}

// Of log(trials), between two neighbours of the best of a grid: golden section.
double narrowed(std::span<const double> grades, const LevelBounds& bounds, double low, double high) {
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

// The number of trials with the least squares; nothing where that is the fastest or the slowest that is looked at.
std::optional<double> trials_of(std::span<const double> grades, const LevelBounds& bounds) {
  const double fastest = std::log(kFastest), slowest = std::log(kSlowest * static_cast<double>(grades.size()));
  const double step = (slowest - fastest) / kGrid;
  int best = 0;
  double least = HUGE_VAL;
  for (int i = 0; i <= kGrid; ++i) {
    const double square = fit_for(grades, std::exp(fastest + step * i), bounds).square;
    if (square < least) least = square, best = i;
  }
  if (best == 0 || best == kGrid) return std::nullopt;
  return std::exp(narrowed(grades, bounds, fastest + step * (best - 1), fastest + step * (best + 1)));
}

// Covariance of level, gain, trials: noise^2 (J^T J)^-1. A level that is held has none.
Eigen::Matrix3d covariance(const LearningCurve& curve, std::size_t count) {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  const double trials = curve.trials.value;
  for (std::size_t i = 0; i < count; ++i) {
    const double n = static_cast<double>(i), decay = std::exp(-n / trials);
    const Eigen::Vector3d slope(1.0, decay, curve.gain.value * decay * n / (trials * trials));
    information += slope * slope.transpose();
  }
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  if (curve.at_bound) {
    const Eigen::Matrix2d free = information.bottomRightCorner<2, 2>();
    spread.bottomRightCorner<2, 2>() = free.inverse();
  } else {
    spread = information.inverse();
  }
  return curve.noise * curve.noise * spread;
}

}  // namespace

double LearningCurve::at(double n) const noexcept {
  return level.value + gain.value * std::exp(-n / trials.value);
}

std::optional<LearningCurve> fit_learning_curve(std::span<const double> grades, const LevelBounds& bounds) {
  if (grades.size() < kLeastTrials) return std::nullopt;
  // A bound bends every straight line: it must not be what there is to see.
  if (!trials_of(grades, {})) return std::nullopt;
  const std::optional<double> trials = trials_of(grades, bounds);
  if (!trials) return std::nullopt;
  const LinearFit fit = fit_for(grades, *trials, bounds);
  LearningCurve curve{{fit.level_and_gain[0]}, {fit.level_and_gain[1]}, {*trials}};
  curve.at_bound = fit.at_bound;
  const double free = fit.at_bound ? 2.0 : 3.0;
  curve.noise = std::sqrt(fit.square / (static_cast<double>(grades.size()) - free));
  const Eigen::Matrix3d spread = covariance(curve, grades.size());
  if (!spread.allFinite()) return std::nullopt;
  curve.level.deviation = std::sqrt(std::max(0.0, spread(0, 0)));
  curve.gain.deviation = std::sqrt(std::max(0.0, spread(1, 1)));
  curve.trials.deviation = std::sqrt(std::max(0.0, spread(2, 2)));
  if (std::abs(curve.gain.value) <= 2.0 * curve.gain.deviation + kNoGain) return std::nullopt;
  return curve;
}

}  // namespace gearshift
