// How well a fitted learning curve is known, trial by trial.
#pragma once

#include <cstddef>

#include "app/training/learning_curve.h"

namespace gearshift {

// Standard deviation of curve.at(n) for n >= 0, where the curve was fitted to `trials` grades: g C g' with
// g = d at(n) / d (level, gain, trials) and C = noise^2 (J'J)^-1, J the slopes at the trials that there were.
// A level at its bound is given: its slope is left out.
double curve_deviation(const LearningCurve& curve, std::size_t trials, double n) noexcept;

}  // namespace gearshift
