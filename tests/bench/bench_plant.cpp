// Integrators of the plant, ns against error: the exact step beside the two that one would write first.
#include <cmath>

#include "haptics/joystick/plant.h"
#include "tests/bench/bench.h"
#include "tests/bench/ticks.h"

namespace gearshift {
namespace {

constexpr double kForce = 10.0;  // [N] held
constexpr double kStart = 0.01;  // [m] at rest
constexpr double kTime = 0.5;    // [s]

// Over-damped axis under a constant force, as a sum of two exponentials in long double: m s^2 + b s + k = 0.
long double closed_form(const AxisModel& axis, long double t) {
  const long double m = axis.mass, b = axis.damping, k = axis.stiffness;
  const long double root = std::sqrt(b * b - 4.0L * m * k);
  const long double slow = -2.0L * k / (b + root), fast = -(b + root) / (2.0L * m);
  const long double rest = kForce / k;
  const long double away = kStart - rest;
  return rest + away * (fast * std::exp(slow * t) - slow * std::exp(fast * t)) / (fast - slow);
}

AxisState euler(const AxisModel& axis, AxisState s, double period) noexcept {
  const double a = (kForce - axis.damping * s.velocity - axis.stiffness * s.position) / axis.mass;
  s.velocity += period * a;
  s.position += period * s.velocity;
  return s;
}

AxisState runge_kutta4(const AxisModel& axis, AxisState s, double h) noexcept {
  const auto slope = [&](AxisState at) {
    return AxisState{at.velocity, (kForce - axis.damping * at.velocity - axis.stiffness * at.position) / axis.mass};
  };
  const auto at = [&](AxisState k, double f) {
    return AxisState{s.position + f * k.position, s.velocity + f * k.velocity};
  };
  const AxisState a = slope(s), b = slope(at(a, h / 2)), c = slope(at(b, h / 2)), d = slope(at(c, h));
  return {s.position + h / 6 * (a.position + 2 * b.position + 2 * c.position + d.position),
          s.velocity + h / 6 * (a.velocity + 2 * b.velocity + 2 * c.velocity + d.velocity)};
}

struct Result {
  double error, ns;
};

template <class Step>
Result measure(const AxisModel& axis, double period, Step step) {
  const int steps = static_cast<int>(std::lround(kTime / period));
  const int repeats = 200000 / steps + 1;
  AxisState state;
  const std::uint64_t before = ticks();
  for (int r = 0; r < repeats; ++r) {
    state = {kStart, 0.0};
    for (int i = 0; i < steps; ++i) state = step(state);
  }
  const double ns = static_cast<double>(ticks() - before) / ticks_per_ns() / (static_cast<double>(steps) * repeats);
  const long double truth = closed_form(axis, kTime);
  return {static_cast<double>(std::abs((state.position - truth) / truth)), ns};
}

void add(std::vector<BenchRow>& rows, const std::string& name, Result result, std::optional<double> goal) {
  rows.push_back({"plant",
                  name,
                  result.error,
                  "relative",
                  goal,
                  false,
                  "after 0.5 s under 10 N, against the sum of two exponentials",
                  true,
                  {{"cost", result.ns, "ns/step"}}});
}

}  // namespace

std::vector<BenchRow> bench_plant(const BenchOptions&) {
  std::vector<BenchRow> rows;
  const AxisModel axis = kPaperAxisX;
  for (const double period : {0.001, 0.01}) {
    const std::string at = period == 0.001 ? " at 1 ms" : " at 10 ms";
    const AxisStepper exact(axis, period);
    add(rows, "exact" + at, measure(axis, period, [&](AxisState s) { return exact.step(s, kForce); }), 1e-12);
    add(rows, "Runge-Kutta 4" + at, measure(axis, period, [&](AxisState s) { return runge_kutta4(axis, s, period); }),
        {});
    add(rows, "symplectic Euler" + at, measure(axis, period, [&](AxisState s) { return euler(axis, s, period); }), {});
  }
  return rows;
}

}  // namespace gearshift
