// Fits a learner's grades with an exponential, which describes one person's practice better than a power law.
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
  // The level is fixed at a bound: its deviation is 0, and the others are those of a fit with the level given.
  bool at_bound = false;

  double at(double n) const noexcept;
};

// Range of the level: grades are bounded, and practice cannot lead beyond the bounds.
struct LevelBounds {
  double lowest = -std::numeric_limits<double>::infinity();  // [1]
  double highest = std::numeric_limits<double>::infinity();  // [1] >= lowest
};

// Least squares with the level within its bounds. Empty with fewer than five trials, or if they show no learning: no
// time constant below ten times the number of trials, with and without the bounds, or a gain within two of its standard
// deviations.
std::optional<LearningCurve> fit_learning_curve(std::span<const double> grades, const LevelBounds& bounds = {});

}  // namespace gearshift::lessons
