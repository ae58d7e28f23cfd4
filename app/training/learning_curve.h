// How a learner's grades rise: an exponential, which fits one person's practice better than a power law.
//
// This work is based on:
// Andrew Heathcote, Scott Brown, D. J. K. Mewhort. The Power Law Repealed. 2000
// Gene Golub, Victor Pereyra. The Differentiation of Pseudo-Inverses and Nonlinear Least Squares Problems. 1973
#pragma once

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

  double at(double n) const noexcept;
};

// Least squares. Nothing where fewer than five trials are there, or where they tell of no learning: no bend within ten
// times the trials that there are, or a gain within two of its deviations.
std::optional<LearningCurve> fit_learning_curve(std::span<const double> grades);

}  // namespace gearshift
