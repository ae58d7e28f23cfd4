// One axis of the joystick as modelled in the paper, stepped exactly.
//
// This work is based on:
// Wei-Ching Lin, Kuu-Young Young. Design of Force-Reflection Joystick System for VR-Based Simulation.
// Eqs (8), (11), (12): m x'' + b x' + k x = f. The force is constant over a step, so the solution is a matrix
// exponential in closed form: exact at any rate.
#pragma once

#include <limits>

#include "haptics/files/parameter.h"

namespace gearshift::haptics {

struct AxisModel {
  double mass = 0.0;       // [kg]
  double damping = 0.0;    // [N s/m]
  double stiffness = 0.0;  // [N/m]
  bool operator==(const AxisModel&) const = default;
};

template <>
inline constexpr Parameter<AxisModel> kParameters<AxisModel>[] = {
    {&AxisModel::mass, "mass", "mass_kg", FileRange{1e-3, 1e3}, "Mass at the tip."},
    {&AxisModel::damping, "damping", "damping_n_s_per_m", FileRange{0.0, 1e4}, "Viscous damping at the tip."},
    {&AxisModel::stiffness, "stiffness", "stiffness_n_per_m", FileRange{0.0, 1e6},
     "Stiffness of the centring spring at the tip."},
};
static_assert(DescribesAll<AxisModel>);

inline constexpr AxisModel kPaperAxisX{0.095, 3.0, 14.8};  // eq (11)
inline constexpr AxisModel kPaperAxisY{0.086, 2.9, 15.7};  // eq (12)

struct AxisState {
  double position = 0.0;  // [m] arc length
  double velocity = 0.0;  // [m/s]
};

// State after `time` >= 0 [s] under a constant force [N]. Valid for over-, under- and critically damped axes.
AxisState advance(const AxisModel& axis, AxisState state, double force, double time) noexcept;

// Like advance(), with the coefficients precomputed for one step length.
class AxisStepper {
 public:
  AxisStepper(const AxisModel& axis, double period) noexcept;  // mass > 0, period [s] >= 0
  AxisState step(AxisState state, double force) const noexcept {
    return {xx_ * state.position + xv_ * state.velocity + xf_ * force,
            vx_ * state.position + vv_ * state.velocity + vf_ * force};
  }

 private:
  double xx_, xv_, vx_, vv_;  // effect of the old state on the new state after one period
  double xf_, vf_;            // effect of the held force on the new state
};

struct AxisLimits {
  double stop = std::numeric_limits<double>::infinity();  // [m] > 0, inelastic hard stops at +stop and -stop
  double coulomb_friction = 0.0;                          // [N] dry friction; 0: none
};

// Like advance(), with dry friction and inelastic hard stops. The axis sticks while the force cannot overcome friction.
// Reversals and impacts inside the step are located, so the result does not depend on the step length. After
// kMaxAxisEvents reversals and impacts in one step the axis is stopped, which can only remove energy.
inline constexpr int kMaxAxisEvents = 64;
AxisState advance_limited(const AxisModel& axis, const AxisLimits& limits, AxisState state, double force,
                          double time) noexcept;

// Mass times the axis's present acceleration [N]; 0 while friction or a stop holds the axis at rest.
double inertial_force(const AxisModel& axis, const AxisLimits& limits, AxisState state, double force) noexcept;

}  // namespace gearshift::haptics
