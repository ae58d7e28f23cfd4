#include "haptics/joystick/plant.h"

#include <algorithm>
#include <cmath>

namespace gearshift::haptics {
namespace {

// Equation of motion x'' + 2 a x' + w2 x = f/m. S(t) is the position after a unit initial velocity (S(0) = 0, S'(0) =
// 1), and I is the integral of S. Then x(t) = (1 - w2 I) x0 + S v0 + I f/m and v(t) = -w2 S x0 + S' v0 + S f/m.
struct Modes {
  double a;     // [1/s] damping / (2 mass)
  double w2;    // [1/s^2] stiffness / mass
  double disc;  // [1/s^2] a^2 - w2: positive if over-damped, negative if under-damped
};

struct Response {
  double free;   // 1 - w2 I: response to a unit initial position
  double s;      // [s] S
  double slope;  // S'
  double i;      // [s^2] I
};

Modes modes(const AxisModel& axis) noexcept {
  const double a = 0.5 * axis.damping / axis.mass, w2 = axis.stiffness / axis.mass;
  return {a, w2, a * a - w2};
}

// Response for short times: the power series of I, from I'' + 2 a I' + w2 I = 1. For short times the closed forms below
// would divide differences of nearly equal numbers (0/0 for a free mass). The series is accurate at any damping.
Response short_response(const Modes& mode, double t) noexcept {
  double before = 0.0, term = 0.5 * t * t;  // terms c_n t^n of the series of I, for n = 1 and n = 2
  double i = term, s_t = 2.0 * term;        // sums of the series of I and of t S = t I'
  for (int n = 3; n <= 32 && std::abs(term) + std::abs(before) > 1e-18 * i; ++n) {
    const double next = -(2.0 * mode.a * t * (n - 1) * term + mode.w2 * t * t * before) / (n * (n - 1));
    before = term;
    term = next;
    i += term;
    s_t += n * term;
  }
  const double s = t > 0.0 ? s_t / t : 0.0;
  return {1.0 - mode.w2 * i, s, 1.0 - 2.0 * mode.a * s - mode.w2 * i, i};
}

// Returns the integral of exp(p t) from 0 to t.
double integral_of_exp(double p, double t) noexcept {
  return p == 0.0 ? t : std::expm1(p * t) / p;
}

// Response for disc >= 0: two real poles p1 >= p2. With a soft spring p1 = -(a - r) would lose digits by cancellation,
// so p1 is computed as w2 / p2.
Response over_damped(const Modes& mode, double t) noexcept {
  const double r = std::sqrt(mode.disc);
  const double p1 = -mode.w2 / (mode.a + r), p2 = -(mode.a + r);
  const double e1 = std::exp(p1 * t), e2 = std::exp(p2 * t);
  const double s = r > 0.0 ? e1 * -std::expm1(-2.0 * r * t) / (2.0 * r) : t * e1;
  const double free = e1 - p1 * s;
  const bool is_separated = r * t >= 0.5;  // false for nearly equal poles, whose integrals cannot be subtracted exactly
  const double i =
      is_separated ? (integral_of_exp(p1, t) - integral_of_exp(p2, t)) / (2.0 * r) : (1.0 - free) / mode.w2;
  return {free, s, e2 + p1 * s, i};
}

// Response for disc < 0: a decaying oscillation.
Response under_damped(const Modes& mode, double t) noexcept {
  const double w = std::sqrt(-mode.disc), decay = std::exp(-mode.a * t);
  const double s = decay * std::sin(w * t) / w, c = decay * std::cos(w * t), free = c + mode.a * s;
  return {free, s, c - mode.a * s, (1.0 - free) / mode.w2};
}

Response response(const Modes& mode, double t) noexcept {
  if (mode.a * t <= 1.0 && mode.w2 * t * t <= 4.0) return short_response(mode, t);
  return mode.disc >= 0.0 ? over_damped(mode, t) : under_damped(mode, t);
}

double sign(double x) noexcept {
  return x < 0.0 ? -1.0 : 1.0;
}

// Time [s] until the velocity is next zero; infinite if it never is. `speed`: present speed [m/s]. `inertial`: mass
// times acceleration in the direction of motion [N]. With the (hyperbolic) cosine C and sine S of the mode:
//     v(t) = exp(-a t) (v0 C + g S), g = v'(0) + a v0
double time_of_reversal(const AxisModel& axis, double speed, double inertial) noexcept {
  const Modes mode = modes(axis);
  const double g = inertial / axis.mass + mode.a * speed;
  if (mode.disc < 0.0) {
    const double w = std::sqrt(-mode.disc);
    return std::atan2(w * speed, -g) / w;
  }
  if (g >= 0.0) return HUGE_VAL;  // the motion slows down to rest without reversing
  const double r = std::sqrt(mode.disc), ratio = -r * speed / g;
  if (ratio >= 1.0) return HUGE_VAL;
  return r > 0.0 ? std::atanh(ratio) / r : -speed / g;
}

// Time [s], between 0 and `end`, at which the motion reaches `position`. The motion must be monotone up to `end`. Uses
// Newton steps, and bisection where a Newton step leaves the bracket.
double time_at(const AxisModel& axis, AxisState start, double force, double end, double position) noexcept {
  const double along = sign(position - start.position);
  double low = 0.0, high = end, t = end;
  for (int i = 0; i < 64; ++i) {
    const AxisState now = advance(axis, start, force, t);
    const double beyond = along * (now.position - position);
    if (beyond == 0.0) break;
    (beyond > 0.0 ? high : low) = t;
    const double newton = t - beyond / (along * now.velocity);
    const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
    if (std::abs(next - t) <= 1e-16 * end) break;
    t = next;
  }
  return t;
}

}  // namespace

AxisStepper::AxisStepper(const AxisModel& axis, double period) noexcept {
  const Modes mode = modes(axis);
  const Response r = response(mode, period);
  xx_ = r.free;
  xv_ = r.s;
  vx_ = -mode.w2 * r.s;
  vv_ = r.slope;
  xf_ = r.i / axis.mass;
  vf_ = r.s / axis.mass;
}

AxisState advance(const AxisModel& axis, AxisState state, double force, double time) noexcept {
  return AxisStepper(axis, time).step(state, force);
}

double inertial_force(const AxisModel& axis, const AxisLimits& limits, AxisState state, double force) noexcept {
  const double net = force - axis.damping * state.velocity - axis.stiffness * state.position;
  if (state.velocity != 0.0) return net - sign(state.velocity) * limits.coulomb_friction;
  const bool is_stuck = std::abs(net) <= limits.coulomb_friction;
  const bool is_held_by_stop = std::abs(state.position) >= limits.stop && net * state.position > 0.0;
  return is_stuck || is_held_by_stop ? 0.0 : net - sign(net) * limits.coulomb_friction;
}

AxisState advance_limited(const AxisModel& axis, const AxisLimits& limits, AxisState state, double force,
                          double time) noexcept {
  for (int event = 0; event < kMaxAxisEvents; ++event) {
    const bool at_stop = std::abs(state.position) >= limits.stop;
    if (at_stop) state.position = std::copysign(limits.stop, state.position);
    if (at_stop && state.velocity * state.position > 0.0) state.velocity = 0.0;

    // Between two events (reversals or impacts) friction is a constant force, so the motion between them has an exact
    // solution.
    const double start = inertial_force(axis, limits, state, force);
    if (state.velocity == 0.0 && start == 0.0) return state;
    const double along = sign(state.velocity != 0.0 ? state.velocity : start);
    const double driven = force - along * limits.coulomb_friction;

    const double reversal = time_of_reversal(axis, std::abs(state.velocity), along * start);
    double span = std::min(time, reversal);
    AxisState next = advance(axis, state, driven, span);
    if (along * next.position > limits.stop) {
      span = time_at(axis, state, driven, span, along * limits.stop);
      next = {along * limits.stop, 0.0};
    } else if (reversal <= time) {
      next.velocity = 0.0;
    }
    state = next;
    time -= span;
    if (time <= 0.0) return state;
  }
  return {state.position, 0.0};
}

}  // namespace gearshift::haptics
