// How a learner's grades rise: an exponential, which fits one person's practice better than a power law.
//
// This work is based on:
// Andrew Heathcote, Scott Brown, D. J. K. Mewhort. The Power Law Repealed. 2000
// Gene Golub, Victor Pereyra. The Differentiation of Pseudo-Inverses and Nonlinear Least Squares Problems. 1973
#pragma once

#include <limits>
#include <optional>
#include <span>

namespace gearshift {

struct Estimate {
  double value = 0.0;
  double deviation = 0.0;  // standard deviation, by the curvature of the fit
};

// grade(n) = level + gain exp(-n / trials), n = 0 for the first trial.
struct LearningCurve {
  Estimate level;      // [1] where it leads
  Estimate gain;       // [1] of the first trial above it; negative for one who improves
  Estimate trials;     // [1] until all but 1/e of it is learnt
  double noise = 0.0;  // [1] standard deviation of a trial about the curve
  // The level is held at a bound: its deviation is 0, the others are those of a fit with that level given.
  bool at_bound = false;

  double at(double n) const noexcept;
};

// Where the level may be: grades have an end, practice leads to none beyond it.
struct LevelBounds {
  double lowest = -std::numeric_limits<double>::infinity();  // [1]
  double highest = std::numeric_limits<double>::infinity();  // [1] >= lowest
};

// Least squares with the level within its bounds. Nothing where fewer than five trials are there, or where they tell of
// no learning: no bend within ten times the trials that there are, with and without the bounds, or a gain within two of
// its deviations.
std::optional<LearningCurve> fit_learning_curve(std::span<const double> grades, const LevelBounds& bounds = {});

}  // namespace gearshift
