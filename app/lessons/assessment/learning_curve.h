// Fits a learner's grades with an exponential, which describes one learner's practice better than a power law.
//
// This work is based on:
// Andrew Heathcote, Scott Brown, D. J. K. Mewhort. The Power Law Repealed. 2000
// Gene Golub, Victor Pereyra. The Differentiation of Pseudo-Inverses and Nonlinear Least Squares Problems. 1973
#pragma once

#include <limits>
#include <optional>
#include <span>

namespace gearshift::lessons {

struct Estimate {
  double value = 0.0;
  double deviation = 0.0;  // standard deviation, from the curvature of the fit
};

// grade(n) = level + gain exp(-n / trials), n = 0 for the first trial.
struct LearningCurve {
  Estimate level;      // [1] asymptote
  Estimate gain;       // [1] first trial minus the level; negative if the learner improves
  Estimate trials;     // [1] trials until 1/e of the gain is left
  double noise = 0.0;  // [1] standard deviation of a trial about the curve
  // True if the level lies at a bound. Its deviation is then 0, and the others are those of a fit with a fixed level.
  bool at_bound = false;

  double at(double n) const noexcept;
};

// Range of the level: grades are bounded, and practice cannot lead beyond the bounds.
struct LevelBounds {
  double lowest = -std::numeric_limits<double>::infinity();  // [1]
  double highest = std::numeric_limits<double>::infinity();  // [1] >= lowest
};

// Fits by least squares with the level within its bounds. Empty with fewer than five trials, or if they show no
// learning: if the best time constant, with or without the bounds, is not between 0.3 trials and ten times the number
// of trials, or if the gain differs from 0 by less than two of its standard deviations.
std::optional<LearningCurve> fit_learning_curve(std::span<const double> grades, const LevelBounds& bounds = {});

}  // namespace gearshift::lessons
