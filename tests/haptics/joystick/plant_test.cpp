#include "haptics/joystick/plant.h"

#include <cmath>
#include <complex>
#include <initializer_list>
#include <random>

#include <doctest/doctest.h>

using namespace gearshift::haptics;

namespace {

using Complex = std::complex<long double>;

// The textbook solution in extended precision: x = f/k + A exp(p1 t) + B exp(p2 t), where p1 and p2 are the roots of m
// p^2 + b p + k, with mass m, damping b and stiffness k.
AxisState by_poles(const AxisModel& axis, AxisState start, double force, double time) {
  const Complex m = axis.mass, b = axis.damping, k = axis.stiffness, t = time;
  const Complex root = std::sqrt(b * b - 4.0L * m * k);
  const Complex p1 = (-b + root) / (2.0L * m), p2 = (-b - root) / (2.0L * m);
  const Complex rest = static_cast<long double>(force) / k;
  const Complex x = Complex(start.position) - rest, v = start.velocity;
  const Complex a1 = (v - p2 * x) / (p1 - p2), a2 = (p1 * x - v) / (p1 - p2);
  const Complex e1 = a1 * std::exp(p1 * t), e2 = a2 * std::exp(p2 * t);
  return {static_cast<double>((rest + e1 + e2).real()), static_cast<double>((p1 * e1 + p2 * e2).real())};
}

// Compares advance() with by_poles(). The tolerance is 1e-12 of the motion's size, |x0| + |v0| / w + |f| / k, with
// natural frequency w and stiffness k.
void check_same(const AxisModel& axis, AxisState start, double force, double time) {
  CAPTURE(axis.mass);
  CAPTURE(axis.damping);
  CAPTURE(axis.stiffness);
  CAPTURE(time);
  const AxisState expected = by_poles(axis, start, force, time), actual = advance(axis, start, force, time);
  const double w = std::sqrt(axis.stiffness / axis.mass);
  const double size = std::abs(start.position) + std::abs(start.velocity) / w + std::abs(force) / axis.stiffness;
  CHECK(std::abs(actual.position - expected.position) <= 1e-12 * size);
  CHECK(std::abs(actual.velocity - expected.velocity) <= 1e-12 * size * w);
}

constexpr AxisState kThrown{0.02, -0.7};

double energy(const AxisModel& axis, AxisState state) {
  return 0.5 * axis.mass * state.velocity * state.velocity + 0.5 * axis.stiffness * state.position * state.position;
}

AxisState in_steps(int steps, double time, const AxisModel& axis, const AxisLimits& limits, AxisState state,
                   double force) {
  for (int i = 0; i < steps; ++i) state = advance_limited(axis, limits, state, force, time / steps);
  return state;
}

}  // namespace

TEST_CASE("the plant is its textbook sum of two exponentials to 1e-12, over- and under-damped, at any step") {
  const AxisModel axes[] = {kPaperAxisX,       kPaperAxisY,        {0.095, 0.3, 500.0}, {0.245, 13.0, 514.8},
                            {0.9, 8.5, 583.0}, {0.1, 0.0, 1000.0}, {0.1, 100.0, 0.5}};
  for (const AxisModel& axis : axes) {
    for (double time : {2.5e-4, 1e-3, 0.01, 0.05, 0.3, 2.0}) {
      check_same(axis, kThrown, 5.0, time);
      check_same(axis, {0.0, 0.0}, 5.0, time);
    }
  }
}

TEST_CASE("a critically damped plant is x = (A + B t) exp(-a t), and it stays accurate close to that") {
  for (double nudge : {0.0, 1e-15, -1e-15, 1e-9, -1e-9}) {
    for (double time : {1e-3, 0.05, 0.11, 1.0}) {
      const double a = 20.0, m = 0.1;  // critically damped: damping 2 m a, stiffness m a^2
      const AxisState actual = advance({m, 2.0 * m * a * (1.0 + nudge), m * a * a}, kThrown, 0.0, time);
      const double slope = kThrown.velocity + a * kThrown.position, decay = std::exp(-a * time);
      const double tolerance = 1e-14 + 0.1 * std::abs(nudge);
      CHECK(std::abs(actual.position - (kThrown.position + slope * time) * decay) < tolerance);
      CHECK(std::abs(actual.velocity - (slope - a * (kThrown.position + slope * time)) * decay) < 20.0 * tolerance);
    }
  }
}

TEST_CASE("without a spring the velocity relaxes to f/b; without a damper too the mass falls freely") {
  for (double time : {1e-4, 1e-3, 0.05, 0.5, 5.0}) {
    const double m = 0.1, b = 3.0, f = 2.0, rate = b / m;
    const AxisState actual = advance({m, b, 0.0}, kThrown, f, time);
    const double relax = std::exp(-rate * time), beyond = kThrown.velocity - f / b;
    CHECK(std::abs(actual.velocity - (f / b + beyond * relax)) < 1e-15);
    const double travel = f / b * time - beyond / rate * std::expm1(-rate * time);
    CHECK(std::abs(actual.position - kThrown.position - travel) < 1e-12 * (0.02 + std::abs(travel)));

    const AxisState falling = advance({m, 0.0, 0.0}, kThrown, f, time);
    CHECK(falling.velocity == doctest::Approx(kThrown.velocity + f / m * time).epsilon(1e-15));
    CHECK(falling.position ==
          doctest::Approx(kThrown.position + kThrown.velocity * time + 0.5 * f / m * time * time).epsilon(1e-14));
  }
}

TEST_CASE("ten steps of T are one step of 10 T") {
  std::mt19937_64 random(7);
  const auto pick = [&](double low, double high) {
    return low * std::pow(high / low, static_cast<double>(random() >> 11) * 0x1p-53);
  };
  for (int i = 0; i < 2000; ++i) {
    const AxisModel axis{pick(0.01, 2.0), pick(0.01, 50.0), pick(0.01, 1e4)};
    const double time = pick(1e-4, 0.05);
    const AxisStepper stepper(axis, time);
    AxisState state = kThrown;
    for (int n = 0; n < 10; ++n) state = stepper.step(state, 3.0);
    const AxisState once = advance(axis, kThrown, 3.0, 10.0 * time);
    const double size = 0.02 + 0.7 * std::sqrt(axis.mass / axis.stiffness) + 3.0 / axis.stiffness;
    CHECK(std::abs(state.position - once.position) < 1e-12 * size);
  }
}

TEST_CASE("a free mass with dry friction stops after m v^2 / 2F, and stays") {
  const AxisModel mass{0.2, 0.0, 0.0};
  const AxisLimits rough{10.0, 0.5};
  const double v = 0.8, distance = 0.2 * v * v / (2.0 * 0.5);
  for (int steps : {1, 7, 1000}) {
    const AxisState end = in_steps(steps, 1.0, mass, rough, {0.0, v}, 0.0);
    CHECK(std::abs(end.position - distance) < 1e-13);
    CHECK(end.velocity == 0.0);
  }
}

TEST_CASE("dry friction takes 2 F / k off a spring's swing in every half period") {
  const AxisModel spring{0.1, 0.0, 100.0};
  const AxisLimits rough{10.0, 0.2};
  const double half_period = std::acos(-1.0) / std::sqrt(100.0 / 0.1), loss = 2.0 * 0.2 / 100.0;
  AxisState state{0.050, 0.0};
  for (int swing = 1; swing <= 10; ++swing) {
    state = advance_limited(spring, rough, state, 0.0, half_period);
    CHECK(std::abs(std::abs(state.position) - (0.050 - swing * loss)) < 1e-12);
  }
}

TEST_CASE("a force below the friction moves nothing; above it, only the difference works") {
  const AxisModel mass{0.1, 0.0, 0.0};
  const AxisLimits rough{10.0, 1.0};
  CHECK(advance_limited(mass, rough, {0.01, 0.0}, 0.999, 1.0).position == 0.01);
  CHECK(advance_limited(mass, rough, {0.0, 0.0}, 1.5, 0.1).velocity == doctest::Approx(0.5).epsilon(1e-13));
}

TEST_CASE("a hard stop takes the whole velocity; it resists a push but not a pull") {
  const AxisModel mass{0.1, 0.0, 0.0};
  const AxisLimits stops{0.05, 0.0};
  const AxisState hit = advance_limited(mass, stops, {0.0, 2.0}, 3.0, 1.0);
  CHECK(hit.position == 0.05);
  CHECK(hit.velocity == 0.0);
  CHECK(inertial_force(mass, stops, hit, 3.0) == 0.0);

  // A force f pulls the lever away from rest at the stop. The lever moves by (f / m) t^2 / 2.
  const AxisState off = advance_limited(mass, stops, hit, -1.0, 0.05);
  CHECK(off.position == doctest::Approx(0.05 - 0.5 * 10.0 * 0.05 * 0.05).epsilon(1e-13));

  // With a spring: the lever hits the stop at 0.05 m, is at rest there, and then swings back as 0.05 cos(w t).
  const AxisModel spring{0.1, 0.0, 100.0};
  const double w = std::sqrt(1000.0), x0 = 0.04, v0 = 3.0, amplitude = std::hypot(x0, v0 / w);
  const double impact = (std::acos(x0 / amplitude) - std::acos(0.05 / amplitude)) / w;
  const AxisState swung = advance_limited(spring, stops, {x0, v0}, 0.0, 0.05);
  CHECK(std::abs(swung.position - 0.05 * std::cos(w * (0.05 - impact))) < 1e-12);
}

TEST_CASE("with friction and stops the step length does not matter, and energy never grows") {
  std::mt19937_64 random(11);
  const auto pick = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53);
  };
  for (int i = 0; i < 500; ++i) {
    const AxisModel axis{pick(0.05, 1.0), pick(0.0, 5.0), pick(0.0, 2000.0)};
    const AxisLimits limits{0.07, pick(0.0, 2.0)};
    const AxisState start{pick(-0.07, 0.07), pick(-3.0, 3.0)};
    const double force = i % 2 == 0 ? pick(-20.0, 20.0) : 0.0;
    const AxisState one = in_steps(1, 0.05, axis, limits, start, force);
    const AxisState fifty = in_steps(50, 0.05, axis, limits, start, force);
    const AxisState fine = in_steps(500, 0.05, axis, limits, start, force);
    CHECK(std::abs(one.position - fifty.position) < 1e-11);
    CHECK(std::abs(one.position - fine.position) < 1e-11);
    CHECK(std::abs(one.velocity - fine.velocity) < 1e-9);
    CHECK(std::abs(one.position) <= 0.07);
    if (force == 0.0) CHECK(energy(axis, one) <= energy(axis, start) * (1.0 + 1e-12));
  }
}

TEST_CASE("more reversals than one step allows end at rest, without adding energy") {
  const AxisModel bell{0.01, 0.0, 1e6};  // 1592 Hz
  const AxisState end = advance_limited(bell, {1.0, 1e-9}, {0.01, 0.0}, 0.0, 1.0);
  CHECK(end.velocity == 0.0);
  CHECK(std::abs(end.position) <= 0.01);
}
