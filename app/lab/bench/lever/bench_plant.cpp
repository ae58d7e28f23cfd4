// Compares integrators for the simulated lever: the exact step, fourth-order Runge-Kutta and symplectic Euler.
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "app/lab/bench/rows/bench.h"
#include "app/lab/bench/rows/ticks.h"
#include "haptics/joystick/plant.h"

namespace gearshift::lab {
namespace {

constexpr double kForce = 10.0;  // [N] constant force on the lever
constexpr double kStart = 0.01;  // [m] start position, at rest
constexpr double kTime = 0.5;    // [s]

// Position of an over-damped axis under a constant force. The rates of the two exponentials are the roots of m s^2 + b
// s + k = 0, with mass m, damping b and stiffness k.
long double closed_form(const haptics::AxisModel& axis, long double t) {
  const long double m = axis.mass, b = axis.damping, k = axis.stiffness;
  const long double root = std::sqrt(b * b - 4.0L * m * k);
  const long double slow = -2.0L * k / (b + root), fast = -(b + root) / (2.0L * m);
  const long double rest = kForce / k;
  const long double away = kStart - rest;
  return rest + away * (fast * std::exp(slow * t) - slow * std::exp(fast * t)) / (fast - slow);
}

haptics::AxisState euler(const haptics::AxisModel& axis, haptics::AxisState s, double period) noexcept {
  const double a = (kForce - axis.damping * s.velocity - axis.stiffness * s.position) / axis.mass;
  s.velocity += period * a;
  s.position += period * s.velocity;
  return s;
}

haptics::AxisState runge_kutta4(const haptics::AxisModel& axis, haptics::AxisState s, double h) noexcept {
  const auto slope = [&](haptics::AxisState at) {
    return haptics::AxisState{at.velocity,
                              (kForce - axis.damping * at.velocity - axis.stiffness * at.position) / axis.mass};
  };
  const auto at = [&](haptics::AxisState k, double f) {
    return haptics::AxisState{s.position + f * k.position, s.velocity + f * k.velocity};
  };
  const haptics::AxisState a = slope(s), b = slope(at(a, h / 2)), c = slope(at(b, h / 2)), d = slope(at(c, h));
  return {s.position + h / 6 * (a.position + 2 * b.position + 2 * c.position + d.position),
          s.velocity + h / 6 * (a.velocity + 2 * b.velocity + 2 * c.velocity + d.velocity)};
}

struct Result {
  double error = 0.0;      // [1] relative
  std::vector<double> ns;  // [ns] time per step, one value per round
};

template <class Step>
void measure_once(const haptics::AxisModel& axis, double period, Step step, Result& into) {
  const int steps = static_cast<int>(std::lround(kTime / period));
  const int repeats = 20000 / steps + 1;
  haptics::AxisState state;
  const std::uint64_t before = ticks();
  for (int r = 0; r < repeats; ++r) {
    state = {kStart, 0.0};
    for (int i = 0; i < steps; ++i) state = step(state);
  }
  into.ns.push_back(static_cast<double>(ticks() - before) / ticks_per_ns() / (static_cast<double>(steps) * repeats));
  const long double truth = closed_form(axis, kTime);
  into.error = static_cast<double>(std::abs((state.position - truth) / truth));
}

BenchRow plant_row(const std::string& method, const std::string& at, Result result) {
  const Timed ns = timed(result.ns);
  const RelatedFigure cost{"cost", ns.median, "ns/step", ns.spread};
  BenchRow row{"plant",
               method + " " + at,
               result.error,
               "relative",
               {},
               false,
               "error after 0.5 s under a 10 N force, compared with the exact solution (two exponentials)",
               true,
               {cost}};
  row.trade = Trade{"plant " + at, method, cost, {"error", result.error, "relative"}};
  return row;
}

// Marks the row as the method that the simulated lever uses. Sets the row's goal and the design requirement to which it
// belongs.
BenchRow shipped(BenchRow row) {
  row.goal = 1e-12;
  row.trade->chosen = true;
  return answers_design(Design::plant, std::move(row));
}

}  // namespace

// The methods run alternately, so that a busy machine slows all of them equally.
std::vector<BenchRow> bench_plant(const BenchOptions&) {
  constexpr int kRounds = 21;  // the cost is the median of these rounds
  std::vector<BenchRow> rows;
  const haptics::AxisModel axis = haptics::kPaperAxisX;
  for (const double period : {0.001, 0.01}) {
    const std::string at = period == 0.001 ? "at 1 ms" : "at 10 ms";
    const haptics::AxisStepper stepper(axis, period);
    Result exact, fourth, first;
    for (int round = 0; round < kRounds; ++round) {
      measure_once(
          axis, period, [&](haptics::AxisState s) { return stepper.step(s, kForce); }, exact);
      measure_once(
          axis, period, [&](haptics::AxisState s) { return runge_kutta4(axis, s, period); }, fourth);
      measure_once(
          axis, period, [&](haptics::AxisState s) { return euler(axis, s, period); }, first);
    }
    rows.push_back(shipped(plant_row("exact", at, std::move(exact))));
    rows.push_back(plant_row("Runge-Kutta 4", at, std::move(fourth)));
    rows.push_back(plant_row("symplectic Euler", at, std::move(first)));
  }
  return rows;
}

}  // namespace gearshift::lab
