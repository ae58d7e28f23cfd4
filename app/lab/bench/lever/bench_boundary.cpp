// Compares the predicted stability limit with the stiffness at which the simulated lever starts to diverge.
#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "app/lab/bench/lever/wall_growth.h"
#include "app/lab/bench/rows/bench.h"

namespace gearshift::lab {
namespace {

struct Drawn {
  haptics::AxisModel handle;
  haptics::HandImpedance hand;
  haptics::ContactLaw law;
  double period = 0.001;
};

Drawn draw(std::mt19937_64& random) {
  const auto unit = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  const auto within = [&](double low, double high) { return low * std::pow(high / low, unit()); };
  Drawn d;
  d.handle = {within(0.05, 0.3), within(0.5, 6.0), 50.0 * unit()};
  if (unit() < 0.7) d.hand = {0.8 * unit(), 12.0 * unit(), 600.0 * unit()};
  d.period = 1e-9 * std::round(1e9 * within(0.00025, 0.01));
  d.law.delay = static_cast<int>(5.0 * unit());
  const double holds = unit();
  d.law.hold = holds < 0.35   ? haptics::ContactHold::zero_order
               : holds < 0.75 ? haptics::ContactHold::half_sample
                              : haptics::ContactHold::observer;
  const double tau = d.period * (d.law.delay + 1);
  d.law.damping = std::min(100.0, 0.5 * d.handle.mass / tau * unit());
  d.law.free_damping = unit() < 0.5 ? 0.0 : std::min(50.0, 0.2 * d.handle.mass / tau * unit());
  d.law.window = unit() < 0.7 ? 1 : 1 + static_cast<int>(8.0 * unit());
  return d;
}

}  // namespace

std::vector<BenchRow> bench_boundary(const BenchOptions& options) {
  std::mt19937_64 random(2026);
  const int wanted = options.quick ? 10 : 100;
  std::vector<double> error;
  int drawn = 0;
  std::string where;
  double worst = 0.0;
  while (static_cast<int>(error.size()) < wanted) {
    if (options.progress) options.progress("boundary", static_cast<double>(error.size()) / wanted);
    const Drawn d = draw(random);
    ++drawn;
    const double predicted = haptics::stiffness_limit(d.handle, d.hand, d.law, d.period);
    if (predicted < 20.0 || predicted > 15000.0) continue;  // outside the valid range of a wall stiffness [N/m]
    const double simulated = simulated_limit(d.handle, d.hand, d.law, d.period, predicted);
    error.push_back(100.0 * std::abs(simulated / predicted - 1.0));
    if (error.back() > worst) {
      worst = error.back();
      where = "draw " + std::to_string(drawn) + ", " + std::to_string(static_cast<int>(predicted)) + " N/m";
    }
  }
  const double median = quantile(error, 0.5);
  return {answers_design(Design::boundary, {"boundary",
                                            "predicted against simulated, " + std::to_string(wanted) + " random levers",
                                            worst,
                                            "%",
                                            2.0,
                                            false,
                                            "worst: " + where + "; no quantisation, no saturation",
                                            true,
                                            {{"median", median, "%"}}})};
}

}  // namespace gearshift::lab
