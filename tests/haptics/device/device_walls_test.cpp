// Tests of device walls, which the simulated lever renders itself.
#include <algorithm>
#include <cmath>
#include <limits>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "haptics/device/simulated_lever.h"
#include "tests/haptics/device/still_hand.h"

using namespace gearshift::haptics;
using namespace gearshift::test;
using glm::dvec2;

namespace {

constexpr std::int64_t kLeverPeriod = 1'000'000;

SimulatedLeverConfig with_walls(double stiffness) {
  SimulatedLeverConfig config;
  config.encoder_counts = 0.0;
  config.force_sensor.resolution_gw = 0.0;
  config.device_wall_stiffness = stiffness;
  return config;
}

struct WallBench {
  explicit WallBench(const SimulatedLeverConfig& config, HandTarget target = {})
      : hand(target), lever(config, kLeverPeriod, hand) {
    lever.read(0);
  }
  LeverReading run(int periods) {
    LeverReading reading;
    for (int i = 0; i < periods; ++i) reading = lever.read(now += kLeverPeriod);
    return reading;
  }

  StillHand hand;
  SimulatedLever lever;
  std::int64_t now = 0;
};

const LeverWalls kRoundMiddle{{-0.001, -0.002}, {0.001, 0.002}, 1.0};

HandTarget pushing(dvec2 force) {
  HandTarget target;
  target.push = force;
  return target;
}

}  // namespace

// Inside a wall of stiffness K, a lever of mass m, damping b and stiffness k obeys m x'' + b x' + k x = -K (x - edge).
// This is a mass on a spring of stiffness k + K, which is solved in closed form.
TEST_CASE("a lever that flies into a device wall moves as a mass on that spring, and returns no faster") {
  for (const double stiffness : {400.0, 1000.0, 3000.0}) {
    CAPTURE(stiffness);
    WallBench bench(with_walls(stiffness));
    bench.lever.set_device_walls(kRoundMiddle);
    const AxisModel inside{kPaperAxisX.mass, kPaperAxisX.damping, kPaperAxisX.stiffness + stiffness};
    AxisState exact{0.001, 0.3};
    bench.lever.place({exact.position, 0.0}, {exact.velocity, 0.0});
    int ms = 0;
    while (exact.position >= 0.001 && ms < 100) {
      CHECK(bench.lever.true_position().x == doctest::Approx(exact.position).epsilon(0.002));
      exact = advance(inside, exact, stiffness * 0.001, 0.001);
      bench.run(1);
      ++ms;
    }
    CHECK(ms < 100);
    CHECK(std::abs(bench.lever.true_velocity().x) < 0.3);
    CHECK(bench.lever.true_velocity().x == doctest::Approx(exact.velocity).epsilon(0.01));
  }
}

TEST_CASE("a push comes to rest where the wall balances it, at any stiffness fraction; no force between the walls") {
  for (const double fraction : {1.0, 0.25}) {
    CAPTURE(fraction);
    WallBench bench(with_walls(1000.0), pushing({0.0, -5.0}));
    LeverWalls walls = kRoundMiddle;
    walls.stiffness_fraction = fraction;
    bench.lever.set_device_walls(walls);
    const LeverReading reading = bench.run(3000);
    const double y = bench.lever.true_position().y, wall = 1000.0 * fraction * (-0.002 - y);
    CHECK(wall - kPaperAxisY.stiffness * y == doctest::Approx(5.0).epsilon(3e-3));  // along an arc
    CHECK(reading.actuator_force.y == doctest::Approx(wall).epsilon(1e-3));
    CHECK(reading.actuator_force.x == doctest::Approx(0.0).scale(1.0));
    CHECK(reading.hand_force.y == doctest::Approx(-5.0).epsilon(1e-3));
  }
  WallBench between(with_walls(1000.0), pushing({0.005, 0.0}));
  between.lever.set_device_walls(kRoundMiddle);
  CHECK(between.run(100).actuator_force == dvec2{0.0, 0.0});
}

TEST_CASE("walls take effect with the delay of any command, and are rendered without delay") {
  SimulatedLeverConfig late = with_walls(1000.0);
  late.delay = 5;
  WallBench bench(late), prompt(with_walls(1000.0));
  for (WallBench* b : {&bench, &prompt}) b->lever.place({0.003, 0.0});
  bench.lever.set_device_walls(kRoundMiddle);
  for (int i = 0; i < 5; ++i) CHECK(bench.run(1).actuator_force.x == 0.0);
  CHECK(bench.run(1).actuator_force.x < -1.0);
  // Once the delay has passed, the wall forces equal those of a lever without delay.
  bench.lever.place({0.001, 0.0}, {0.3, 0.0});
  prompt.lever.set_device_walls(kRoundMiddle);
  prompt.lever.place({0.001, 0.0}, {0.3, 0.0});
  for (int i = 0; i < 20; ++i) CHECK(bench.run(1).actuator_force == prompt.run(1).actuator_force);
}

TEST_CASE("walls and command share the motors: together they are limited to the motors' force") {
  SimulatedLeverConfig config = with_walls(3000.0);
  config.actuator.peak_force = config.actuator.continuous_force = 8.0;
  WallBench bench(config, pushing({7.0, 0.0}));
  bench.lever.write({-5.0, 0.0});
  bench.lever.set_device_walls(kRoundMiddle);
  CHECK(bench.run(2000).actuator_force.x == doctest::Approx(-7.0).epsilon(0.01));  // -5 N commanded, -2 N from the wall
  WallBench beyond(config, pushing({20.0, 0.0}));
  beyond.lever.set_device_walls(kRoundMiddle);
  CHECK(beyond.run(12).actuator_force.x == doctest::Approx(-8.0).epsilon(0.01));
}

// A hand of 2.4 kg pushes 55 N against a spring that yields at 31.7 N, far from the middle, where the joints turn forces. A
// spring that is limited along its own axis does no work round a closed path, so the swing decays at the rate of mass and
// dampers, b / 2 m. Limited on each joint, it kept a swing of 1.4 mm alive for good.
TEST_CASE("a heavy hand that overpowers a device wall swings out as its mass and dampers say") {
  SimulatedLeverConfig config = with_walls(2958.0);
  config.actuator.continuous_force = config.actuator.peak_force;
  config.hand = {2.4, 8.38, 290.1};
  HandTarget target = pushing({0.0, -55.0});
  target.position = {0.05, -0.0318};
  WallBench bench(config, target);
  bench.lever.set_device_walls({{-1.0, -0.0318}, {1.0, 1.0}, 1.0});
  const auto swing_in_a_second = [&] {
    double lowest = 1.0, highest = -1.0;  // [m]
    for (int ms = 0; ms < 1000; ++ms) {
      bench.run(1);
      lowest = std::min(lowest, bench.lever.true_position().x);
      highest = std::max(highest, bench.lever.true_position().x);
    }
    return highest - lowest;
  };
  bench.run(1000);
  const double left = std::exp(-0.5 * (kPaperAxisX.damping + 8.38) / (kPaperAxisX.mass + 2.4));  // after each second
  double swing = swing_in_a_second();
  CHECK(swing > 0.003);
  for (int second = 0; second < 4; ++second) {
    const double next = swing_in_a_second();
    CHECK(next < 1.5 * left * swing);
    swing = next;
  }
}

TEST_CASE("release removes the walls, including those still delayed; a wall that is not finite is ignored") {
  SimulatedLeverConfig late = with_walls(1000.0);
  late.delay = 3;
  WallBench bench(late, pushing({3.0, 0.0}));
  bench.lever.set_device_walls(kRoundMiddle);
  CHECK(bench.run(500).actuator_force.x < -1.0);
  bench.lever.release();
  CHECK(bench.run(1).actuator_force == dvec2{0.0, 0.0});
  CHECK(bench.run(10).actuator_force == dvec2{0.0, 0.0});
  LeverWalls nonsense = kRoundMiddle;
  nonsense.high.x = std::numeric_limits<double>::quiet_NaN();
  bench.lever.set_device_walls(nonsense);
  CHECK(bench.run(10).actuator_force == dvec2{0.0, 0.0});
}

TEST_CASE("a lever without device walls reports so and ignores them") {
  CHECK(WallBench(with_walls(700.0)).lever.spec().device_wall_stiffness == dvec2{700.0, 700.0});
  WallBench none(with_walls(0.0), pushing({3.0, 0.0}));
  CHECK(none.lever.spec().device_wall_stiffness == dvec2{0.0, 0.0});
  none.lever.set_device_walls(kRoundMiddle);
  CHECK(none.run(100).actuator_force == dvec2{0.0, 0.0});
}
