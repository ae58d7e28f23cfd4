// Uncertainty of a fitted learning curve, trial by trial.
#pragma once

#include <cstddef>

#include "app/lessons/assessment/learning_curve.h"

namespace gearshift::lessons {

// Standard deviation of curve.at(n) for n >= 0, with the curve fitted to `trials` grades: sqrt(g C g') with g = d at(n)
// / d (level, gain, trials) and C = noise^2 (J'J)^-1, where J holds the slopes at the fitted trials. A level at its
// bound is fixed, so its slope is left out.
double curve_deviation(const LearningCurve& curve, std::size_t trials, double n) noexcept;

}  // namespace gearshift::lessons
