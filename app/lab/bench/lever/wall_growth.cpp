#include "app/lab/bench/lever/wall_growth.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "haptics/gate/plain_aisle.h"
#include "haptics/loop/simulated_run.h"

namespace gearshift::lab {
namespace {

using glm::dvec2;

constexpr double kGrownWall = 0.002;  // [m]
constexpr double kDepth = 0.002;      // [m] depth of the lever at rest
// [1] A run ends when the disturbance exceeds this fraction of the lever's depth in the wall. Up to this fraction, the
// cycle is linear.
constexpr double kFar = 0.05;
constexpr int kSettle = 12000;  // [cycles] time to settle in a softer, stable wall
constexpr int kRamp = 3000;     // [cycles] ramp from the softer wall to the wall under test, at constant depth
constexpr int kCycles = 6000;   // [cycles] maximum time in the wall under test

// Presses the lever into the wall and holds it there with the hand's spring.
class PressingHand final : public haptics::HandDriver {
 public:
  haptics::HandTarget next(double, dvec2) noexcept override {
    haptics::HandTarget target;
    target.position = {kGrownWall + kDepth, 0.0};
    target.push = {push, 0.0};
    return target;
  }

  double push = 0.0;  // [N]
};

haptics::SimulatedRunConfig rig(const haptics::AxisModel& handle, const haptics::HandImpedance& hand,
                                const haptics::ContactLaw& law, double period) {
  haptics::SimulatedRunConfig config;
  config.haptics.rate = 1.0 / period;
  config.haptics.contact = {law.hold, haptics::EnergyControl::none, false, true};
  config.haptics.tuning.wall_stiffness = law.stiffness;
  config.haptics.tuning.wall_damping = law.damping;
  config.haptics.tuning.aisle_damping = law.free_damping;
  config.haptics.tuning.limit_damping = 0.0;
  config.haptics.estimator.smoothing = law.smoothing;
  config.haptics.estimator.window = law.window;
  config.haptics.guard.slew = 100.0;
  config.haptics.guard.ramp_time = 0.001;
  config.lever.axis_x = config.lever.axis_y = handle;
  config.lever.encoder_counts = 0.0;
  config.lever.force_sensor.resolution_gw = 0.0;
  config.lever.actuator = {1e4, 1e4, 1.0};
  config.lever.delay = law.delay;
  config.lever.hand = hand;
  config.gate = haptics::plain_aisle(0.060, 0.060);
  config.gate.select_max = kGrownWall;
  config.start = {kGrownWall + kDepth, 0.0};
  return config;
}

double span(const std::vector<double>& x, std::size_t from, std::size_t to) {
  const auto begin = x.begin() + static_cast<std::ptrdiff_t>(from), end = x.begin() + static_cast<std::ptrdiff_t>(to);
  const auto [low, high] = std::minmax_element(begin, end);
  return *high - *low;
}

// Growth of the peak-to-peak motion per cycle, from the middle third of the record to the last third. [1]
double growth(const std::vector<double>& x) {
  const std::size_t third = x.size() / 3;
  if (third < 10) return HUGE_VAL;  // the lever diverged immediately
  const double early = span(x, third, 2 * third), late = span(x, 2 * third, 3 * third);
  if (early < 1e-12) return 0.0;  // [m] smaller motion is rounding error
  return std::pow(late / early, 1.0 / static_cast<double>(third));
}

}  // namespace

double simulated_growth(const haptics::AxisModel& handle, const haptics::HandImpedance& hand,
                        const haptics::ContactLaw& law, double period, double settle) {
  PressingHand driver;
  haptics::SimulatedRunConfig config = rig(handle, hand, law, period);
  config.haptics.tuning.wall_stiffness = settle;
  haptics::SimulatedRun run(config, driver);
  const auto press = [&](int n) {  // balances the wall force in effect in cycle n, computed in cycle n - delay
    const double fraction = std::clamp(static_cast<double>(n - law.delay) / kRamp, 0.0, 1.0);
    const double stiffness = settle + fraction * (law.stiffness - settle);
    driver.push = stiffness * kDepth + handle.stiffness * (kGrownWall + kDepth);
  };
  for (int n = -kSettle; n < kRamp + law.delay; ++n) {
    press(n - 1);
    const double fraction = std::clamp(static_cast<double>(n) / kRamp, 0.0, 1.0);
    config.haptics.tuning.wall_stiffness = settle + fraction * (law.stiffness - settle);
    run.inputs().tuning.write(config.haptics.tuning);
    run.step();
  }
  press(kRamp + law.delay);
  std::vector<double> x;
  for (int n = 0; n < kCycles; ++n) {
    run.step();
    x.push_back(run.lever().true_position().x);
    if (std::abs(x.back() - kGrownWall - kDepth) > kFar * kDepth) break;
  }
  return growth(x);
}

double simulated_limit(const haptics::AxisModel& handle, const haptics::HandImpedance& hand, haptics::ContactLaw law,
                       double period, double guess) {
  double stable = 0.96 * guess, unstable = 1.04 * guess;
  while (unstable > 1.001 * stable) {
    law.stiffness = std::sqrt(stable * unstable);
    (simulated_growth(handle, hand, law, period, 0.2 * guess) < 1.0 ? stable : unstable) = law.stiffness;
  }
  return std::sqrt(stable * unstable);
}

}  // namespace gearshift::lab
