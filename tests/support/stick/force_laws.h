// The forces of effects by the laws of PID 1.0 and of real firmware: pure functions. X is to the right, Y towards the
// user. Forces and deflections are fractions of the full force and of the full deflection.
#pragma once

#include <glm/vec2.hpp>

#include "tests/support/stick/device_effects.h"
#include "tests/support/stick/stick_habits.h"

namespace gearshift::test {

// Force towards the centre, proportional to the deflection beyond the dead band. `slope`: force with coefficient 1 at
// deflection 1.
double condition_force(const AxisCondition& condition, double deflection, double slope,
                       DeadBandLaw law = DeadBandLaw::honoured) noexcept;

// Adds the force of a constant effect to `sum`.
void add_constant(const DeviceEffect& effect, const StickHabits& habits, glm::dvec2& sum) noexcept;

// Force of a spring (of deflections) or of a damper (of speeds, slope 1).
glm::dvec2 condition_forces(const DeviceEffect& effect, const StickHabits& habits, glm::dvec2 deflection,
                            double slope) noexcept;

// Updates the state that the board's law keeps with an effect. Call them when the effect was set, and when one of its
// conditions was set.
void on_effect_set(DeviceEffect& effect) noexcept;
void on_condition_told(DeviceEffect& effect, std::size_t axis) noexcept;

}  // namespace gearshift::test
