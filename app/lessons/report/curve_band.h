// Uncertainty of a fitted learning curve, trial by trial.
#pragma once

#include <cstddef>

#include "app/lessons/assessment/learning_curve.h"

namespace gearshift::lessons {

inline constexpr double kBandDeviations = 2.0;  // [1] half width of a band with about 95 % confidence, in deviations

// Standard deviation of curve.at(n), for n >= 0 and a curve fitted to `trials` grades: sqrt(g C g'). The gradient g
// contains the derivatives of at(n) with respect to level, gain and trials. The covariance C is noise^2 (J'J)^-1, where
// the rows of J are the gradients at the fitted trials. A level at its bound is fixed, so its derivative is left out.
double curve_deviation(const LearningCurve& curve, std::size_t trials, double n) noexcept;

}  // namespace gearshift::lessons
