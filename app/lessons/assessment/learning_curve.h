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
  double deviation = 0.0;  // standard deviation of the estimate, from the curvature of the squared error
};

// grade(n) = level + gain exp(-n / trials), with n = 0 for the first trial.
struct LearningCurve {
  Estimate level;      // [1] asymptote
  Estimate gain;       // [1] fitted grade of the first trial minus the level; negative if the learner improves
  Estimate trials;     // [1] time constant: number of trials until 1/e of the gain is left
  double noise = 0.0;  // [1] standard deviation of the grades around the curve
  // True if the level lies at a bound. The level's deviation is then 0, and the other deviations assume a fixed level.
  bool at_bound = false;

  double at(double n) const noexcept;
};

// Allowed range of the level, because practice cannot lead beyond the best or the worst grade.
struct LevelBounds {
  double lowest = -std::numeric_limits<double>::infinity();  // [1]
  double highest = std::numeric_limits<double>::infinity();  // [1] >= lowest
};

// Least-squares fit with the level within its bounds. Returns empty with fewer than five trials, or if the grades show
// no learning. They show none if the best time constant, with or without bounds, is not between 0.3 trials and ten
// times the number of trials, or if the gain is less than two of its standard deviations from 0.
std::optional<LearningCurve> fit_learning_curve(std::span<const double> grades, const LevelBounds& bounds = {});

}  // namespace gearshift::lessons
