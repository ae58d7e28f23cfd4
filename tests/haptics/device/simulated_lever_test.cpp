#include "haptics/device/simulated_lever.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "tests/haptics/device/still_hand.h"

using namespace gearshift::haptics;
using namespace gearshift::test;

namespace {

constexpr std::int64_t kMillisecond = 1'000'000;
constexpr YokeGeometry kYoke;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Joint torques of a force along the arcs of the tip. The arc lengths are rho theta and -rho phi, with radius rho =
// 0.120 m.
JointTorques torques_along(glm::dvec2 arc_force) {
  return {0.120 * arc_force.x, -0.120 * arc_force.y};
}

// A lever whose encoder and force sensor are exact, without resolution steps.
SimulatedLeverConfig exact(const HandImpedance& hand = kBareHand) {
  SimulatedLeverConfig config;
  config.encoder_counts = 0.0;
  config.force_sensor.resolution_gw = 0.0;
  config.hand = hand;
  return config;
}

// A lever with its clock; run(n) advances n periods.
struct Bench {
  Bench(const SimulatedLeverConfig& config, const HandTarget& target, std::int64_t period = kMillisecond)
      : hand(target), lever(config, period, hand), period_ns(period) {
    reading = lever.read(0);
  }
  void run(int periods) {
    for (int i = 0; i < periods; ++i) reading = lever.read(now += period_ns);
  }
  glm::dvec2 arc() const { return arc_position(kYoke, joint_angles_from_plane(kYoke, lever.true_position())); }

  StillHand hand;
  SimulatedLever lever;
  std::int64_t period_ns, now = 0;
  LeverReading reading;
};

// Position of a lever that a hand with stiffness k_h leads from rest at 0 towards `target`. Solves m x'' + b x' + k x =
// k_h target, where mass m, damping b and stiffness k are the sums of lever and hand.
double position_led_to(const AxisModel& axis, const HandImpedance& hand, double target, double time) {
  using Complex = std::complex<double>;
  const Complex m = axis.mass + hand.mass, b = axis.damping + hand.damping, k = axis.stiffness + hand.stiffness;
  const Complex root = std::sqrt(b * b - 4.0 * m * k), p1 = (-b + root) / (2.0 * m), p2 = (-b - root) / (2.0 * m);
  const Complex transient = (p2 * std::exp(p1 * time) - p1 * std::exp(p2 * time)) / (p1 - p2);
  return (hand.stiffness * target / k * (1.0 + transient)).real();
}

std::string refusal(const SimulatedLeverConfig& config, std::int64_t period = kMillisecond) {
  StillHand hand;
  try {
    SimulatedLever(config, period, hand);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("handle and hand are one axis: led to a point, each arc is the textbook's two exponentials") {
  for (const HandImpedance& hand : {kLightHand, kGripHand, kArmHand}) {
    const glm::dvec2 point{0.030, -0.040};
    const glm::dvec2 target = arc_position(kYoke, joint_angles_from_plane(kYoke, point));
    Bench bench(exact(hand), hand_at(point));
    for (int ms = 1; ms <= 400; ++ms) {
      bench.run(1);
      CHECK(std::abs(bench.arc().x - position_led_to(kPaperAxisX, hand, target.x, ms * 1e-3)) < 1e-13);
      CHECK(std::abs(bench.arc().y - position_led_to(kPaperAxisY, hand, target.y, ms * 1e-3)) < 1e-13);
    }
  }
}

TEST_CASE("a written force rests where it is the gradient of the springs' energy over the gate plane") {
  const glm::dvec2 force{0.8, 0.6};
  Bench bench(exact(), {});
  bench.lever.write(force);
  bench.run(20'000);
  const auto stored = [](glm::dvec2 plane) {
    const glm::dvec2 arc = arc_position(kYoke, joint_angles_from_plane(kYoke, plane));
    return 0.5 * 14.8 * arc.x * arc.x + 0.5 * 15.7 * arc.y * arc.y;
  };
  const glm::dvec2 here = bench.lever.true_position(), dx{1e-5, 0.0}, dy{0.0, 1e-5};
  CHECK(std::min(here.x, here.y) > 0.025);  // far from the centre on both axes
  CHECK((stored(here + dx) - stored(here - dx)) / 2e-5 == doctest::Approx(force.x).epsilon(1e-7));
  CHECK((stored(here + dy) - stored(here - dy)) / 2e-5 == doctest::Approx(force.y).epsilon(1e-7));
  CHECK(glm::length(bench.reading.actuator_force - force) < 1e-13);
  CHECK(glm::length(bench.reading.hand_force) < 1e-9);
}

TEST_CASE("the hand's force is m a + b v + k x - f of the handle, the hand's own inertia included") {
  const double step = 1e-4;  // [s]
  Bench bench(exact(kArmHand), hand_at({0.030, 0.025}), 100'000);
  bench.lever.write({-2.0, 1.0});
  bench.run(200);
  for (int i = 0; i < 500; ++i) {
    const glm::dvec2 before = bench.arc();
    bench.run(1);
    const glm::dvec2 now = bench.arc(), measured = bench.reading.hand_force, motors = bench.reading.actuator_force;
    const JointAngles q = joint_angles_from_plane(kYoke, bench.lever.true_position());
    bench.run(1);
    const glm::dvec2 after = bench.arc();

    const glm::dvec2 a = (after - 2.0 * now + before) / (step * step), v = (after - before) / (2.0 * step);
    const glm::dvec2 on_handle{0.095 * a.x + 3.0 * v.x + 14.8 * now.x, 0.086 * a.y + 2.9 * v.y + 15.7 * now.y};
    const glm::dvec2 expected = plane_force(kYoke, q, torques_along(on_handle)) - motors;
    CHECK(glm::length(measured - expected) < 2e-3);
  }
}

namespace {

// Position of a lever without limits, in an elastic hand that pushes with a sine of 0.1 N: the amplitude of the steady
// motion. Handle m, b, k with fingers m_f; hand M, B, K; grip g = k_g + j w b_g:
//     (k - w^2 (m + m_f) + j w b + g) x = g x_h,   (K - w^2 M + j w B + g) x_h = g x + 0.1
std::complex<double> swing_of(const AxisModel& handle, const HandImpedance& hand, double w) {
  using Complex = std::complex<double>;
  const Complex grip{hand.grip_stiffness, w * hand.grip_damping};
  const Complex lever = Complex{handle.stiffness - w * w * (handle.mass + hand.finger_mass), w * handle.damping} + grip;
  const Complex mass = Complex{hand.stiffness - w * w * hand.mass, w * hand.damping} + grip;
  return 0.1 * grip / (lever * mass - grip * grip);
}

// Pushes with a sine. The push is held for a period.
struct SinePush final : HandDriver {
  explicit SinePush(double rate) : w(rate) {}
  HandTarget next(double time, glm::dvec2) noexcept override {
    HandTarget target;
    target.push = glm::dvec2(0.1 * std::sin(w * time));
    return target;
  }
  double w;
};

const HandImpedance kElasticCases[] = {
    kElasticHand, kPinchHand, {2.5, 20.0, 1500.0, 0.02, 4.0, 8000.0}, {0.1, 3.0, 300.0, 0.0, 0.0, 4000.0}};

}  // namespace

TEST_CASE("an elastic hand swings the lever as two masses do, in closed form") {
  for (const HandImpedance& hand : kElasticCases) {
    for (const double frequency : {1.0, 10.0, 40.0, 100.0}) {
      CAPTURE(hand.grip_stiffness);
      CAPTURE(frequency);
      constexpr std::int64_t kPeriod = 100'000;
      constexpr double kStep = 1e-4;
      const double w = 2.0 * std::numbers::pi * frequency;
      SinePush push(w);
      SimulatedLever lever(exact(hand), kPeriod, push);
      lever.read(0);
      const int settle = 60'000, count = 10'000;  // whole seconds
      std::complex<double> sum{};
      for (int i = 1; i <= settle + count; ++i) {
        lever.read(i * kPeriod);
        const double x = arc_position(kYoke, joint_angles_from_plane(kYoke, lever.true_position())).x;
        if (i > settle) sum += x * std::polar(2.0 / count, -w * kStep * i);
      }
      // Held for a period, the push is late by half of one and weaker by sin(u)/u.
      const double u = 0.5 * w * kStep;
      const std::complex<double> push_phasor = std::complex<double>{0.0, -1.0} * std::polar(std::sin(u) / u, -u);
      const std::complex<double> expected = push_phasor * swing_of(kPaperAxisX, hand, w);
      CHECK(std::abs(sum - expected) < 1e-3 * std::abs(expected));
    }
  }
}

// The hand's position follows from its force on the lever, k_g (x_h - x) without grip damping and fingers, and the speeds
// from differences.
TEST_CASE("an elastic hand keeps its energy for 20 s without dampers, and loses it with them") {
  for (HandImpedance hand : kElasticCases) {
    for (const bool is_damped : {false, true}) {
      CAPTURE(hand.grip_stiffness);
      CAPTURE(is_damped);
      hand.finger_mass = hand.grip_damping = 0.0;
      if (!is_damped) hand.damping = 0.0;
      SimulatedLeverConfig config = exact(hand);
      AxisModel& axis = config.axis_x;
      if (!is_damped) axis.damping = 0.0;
      constexpr double kStep = 1e-4;
      Bench bench(config, {}, 100'000);
      bench.lever.place({0.002, 0.0}, {0.05, 0.0});
      std::array<double, 3> lever{}, mass{};  // positions, the newest last
      double first = 0.0, before = 0.0, least = 1e9, most = 0.0, rise = 0.0;
      for (int i = 0; i < 200'000; ++i) {
        bench.run(1);
        std::shift_left(lever.begin(), lever.end(), 1);
        std::shift_left(mass.begin(), mass.end(), 1);
        lever.back() = bench.arc().x;
        mass.back() = lever.back() + bench.reading.hand_force.x / hand.grip_stiffness;
        if (i < 2) continue;
        const auto squared = [](double value) { return value * value; };
        const double energy = 0.5 * axis.mass * squared((lever[2] - lever[0]) / (2.0 * kStep)) +
                              0.5 * hand.mass * squared((mass[2] - mass[0]) / (2.0 * kStep)) +
                              0.5 * axis.stiffness * squared(lever[1]) + 0.5 * hand.stiffness * squared(mass[1]) +
                              0.5 * hand.grip_stiffness * squared(mass[1] - lever[1]);
        if (i == 2) first = before = energy;
        rise = std::max(rise, energy - before);
        before = energy;
        least = std::min(least, energy);
        most = std::max(most, energy);
      }
      CHECK(first == doctest::Approx(0.5 * (axis.mass + hand.mass) * 0.0025).epsilon(0.05));
      CHECK(rise < 2e-3 * first);
      if (is_damped) CHECK(least < 1e-6 * first);
      if (!is_damped) CHECK(most - least < 2e-3 * first);
    }
  }
}

// The reference is a Runge-Kutta solution of the two masses in steps of 1 us.
TEST_CASE("an elastic hand: the error is below 0.02 % of the motion at any period of the loop") {
  for (const HandImpedance& hand : kElasticCases) {
    for (const std::int64_t period : {250'000, 1'000'000, 5'000'000, 10'000'000}) {
      CAPTURE(hand.grip_stiffness);
      CAPTURE(period);
      Bench bench(exact(hand), {}, period);
      bench.lever.place({0.0, 0.0}, {0.01, 0.0});
      bench.lever.write({0.1, 0.0});
      using State = std::array<double, 4>;
      const AxisModel& axis = kPaperAxisX;
      const auto slope = [&](const State& s) {
        const double grip = hand.grip_stiffness * (s[2] - s[0]) + hand.grip_damping * (s[3] - s[1]);
        return State{s[1], (0.1 + grip - axis.damping * s[1] - axis.stiffness * s[0]) / (axis.mass + hand.finger_mass),
                     s[3], (-grip - hand.damping * s[3] - hand.stiffness * s[2]) / hand.mass};
      };
      const auto ahead = [](const State& s, const State& d, double h) {
        return State{s[0] + h * d[0], s[1] + h * d[1], s[2] + h * d[2], s[3] + h * d[3]};
      };
      State now{0.0, 0.01, 0.0, 0.01};
      double error = 0.0, widest = 0.0;
      const int steps = static_cast<int>(period / 1000);
      for (std::int64_t t = period; t <= 400'000'000; t += period) {
        for (int i = 0; i < steps; ++i) {
          constexpr double h = 1e-6;
          const State a = slope(now), b = slope(ahead(now, a, 0.5 * h)), c = slope(ahead(now, b, 0.5 * h)),
                      d = slope(ahead(now, c, h));
          for (std::size_t k = 0; k < 4; ++k) now[k] += h / 6.0 * (a[k] + 2.0 * b[k] + 2.0 * c[k] + d[k]);
        }
        bench.run(1);
        error = std::max(error, std::abs(bench.arc().x - now[0]));
        widest = std::max(widest, std::abs(now[0]));
      }
      CHECK(error < 2e-4 * widest);
    }
  }
}

TEST_CASE("an elastic hand without mass is refused") {
  CHECK(refusal(exact({0.0, 1.0, 100.0, 0.01, 1.0, 1000.0})).find("mass_kg of an elastic hand") != std::string::npos);
}

TEST_CASE("a joint is read at the middle of its encoder cell: 2250 counts over 80 deg are 74.5 um") {
  SimulatedLeverConfig config;
  config.hand = kLightHand;
  Bench bench(config, hand_at({0.05, 0.05}));
  CHECK(bench.lever.spec().position_step == doctest::Approx(74.5e-6).epsilon(1e-3));
  const double cell = 80.0 / 2250.0 * std::numbers::pi / 180.0;
  for (int i = 0; i < 500; ++i) {
    bench.run(1);
    const JointAngles read = joint_angles_from_plane(kYoke, bench.reading.position);
    const JointAngles real = joint_angles_from_plane(kYoke, bench.lever.true_position());
    CHECK(std::abs(read.theta / cell - (std::floor(real.theta / cell) + 0.5)) < 1e-9);
    CHECK(std::abs(read.phi / cell - (std::floor(real.phi / cell) + 0.5)) < 1e-9);
  }
}

TEST_CASE("the true position is the same with and without an encoder") {
  SimulatedLeverConfig quantised = exact(kGripHand);
  quantised.encoder_counts = 2250.0 / 80.0;
  Bench with(quantised, hand_at({0.06, -0.05})), without(exact(kGripHand), hand_at({0.06, -0.05}));
  for (int i = 0; i < 300; ++i) {
    with.run(1);
    without.run(1);
    CHECK(glm::length(with.lever.true_position() - without.lever.true_position()) < 1e-15);
  }
}

TEST_CASE("a force takes effect after the delay and not a sample earlier") {
  for (int delay = 0; delay <= kMaxSimulatedDelay; ++delay) {
    SimulatedLeverConfig config = exact();
    config.delay = delay;
    Bench bench(config, {});
    bench.run(3);
    bench.lever.write({5.0, -5.0});
    bench.run(delay);
    CHECK(bench.lever.true_velocity() == glm::dvec2(0.0));
    bench.run(1);
    CHECK(bench.lever.true_velocity().x > 0.0);
    CHECK(bench.lever.true_velocity().y < 0.0);
    CHECK(bench.reading.actuator_force.x == doctest::Approx(5.0).epsilon(1e-14));
  }
}

TEST_CASE("release drops the force and those still delayed") {
  SimulatedLeverConfig config = exact();
  config.delay = 4;
  Bench bench(config, {});
  bench.lever.write({5.0, 5.0});
  bench.run(2);
  bench.lever.release();
  bench.run(20);
  CHECK(bench.lever.true_position() == glm::dvec2(0.0));
}

TEST_CASE("motors saturate at 31.7 N, and at 10.83 N once they are hot") {
  Bench bench(exact(), hand_pushing({60.0, 0.0}));
  bench.lever.write({-60.0, 0.0});
  bench.run(1);
  CHECK(bench.reading.actuator_force.x == doctest::Approx(-31.7).epsilon(1e-12));
  bench.lever.place({0.0, 0.0});
  bench.run(5010);  // 5.01 s, longer than overload_time (5 s)
  const JointAngles q = joint_angles_from_plane(kYoke, bench.lever.true_position());
  const glm::dvec2 hot = plane_force(kYoke, q, torques_along({-10.83, 0.0}));
  CHECK(bench.reading.actuator_force.x == doctest::Approx(hot.x).epsilon(1e-9));
}

TEST_CASE("60 N push the lever to its stops, 77 mm to the side and 69 mm forward, without a bounce") {
  Bench bench(exact(), hand_pushing({60.0, 0.0}));
  bench.lever.write({-31.7, 0.0});
  bench.run(1000);
  CHECK(bench.lever.true_position().x == doctest::Approx(0.120 * std::sin(40.0 * std::numbers::pi / 180.0)));
  CHECK(bench.lever.true_velocity() == glm::dvec2(0.0));
  CHECK(bench.reading.hand_force.x == doctest::Approx(60.0).epsilon(1e-12));
  CHECK(bench.lever.spec().workspace.x == doctest::Approx(0.0771).epsilon(1e-3));

  Bench forward(exact(), hand_pushing({0.0, 60.0}));
  forward.run(1000);
  CHECK(forward.lever.true_position().y == doctest::Approx(0.120 * std::sin(35.0 * std::numbers::pi / 180.0)));
  CHECK(forward.lever.spec().workspace.y == doctest::Approx(0.0688).epsilon(1e-3));
}

TEST_CASE("dry friction holds the lever against smaller forces") {
  SimulatedLeverConfig config = exact();
  config.coulomb_friction = 0.5;
  Bench bench(config, {});
  bench.lever.write({0.49, -0.49});
  bench.run(1000);
  CHECK(bench.lever.true_position() == glm::dvec2(0.0));
  bench.lever.write({0.6, 0.0});
  bench.run(20'000);
  CHECK(bench.arc().x == doctest::Approx(0.1 / 14.8).epsilon(1e-3));  // spring force = 0.6 N push - 0.5 N friction
}

TEST_CASE("time advances in whole periods: n periods are n sequence numbers; no advance, or backward, is stale") {
  StillHand hand;
  SimulatedLever lever(SimulatedLeverConfig{}, kMillisecond, hand);
  const std::int64_t start = 12'345'678'901;
  const LeverReading first = lever.read(start);
  CHECK(first.time_ns == start);
  CHECK(lever.read(start + 400'000).sequence == first.sequence);
  CHECK(lever.read(start - 5 * kMillisecond).sequence == first.sequence);
  const LeverReading second = lever.read(start + 1'100'000);  // 10 % late
  CHECK(second.sequence == first.sequence + 1);
  CHECK(second.time_ns == start + kMillisecond);
  CHECK(lever.read(start + 2 * kMillisecond - 100'000).sequence == first.sequence + 2);
  CHECK(lever.read(start + 7 * kMillisecond).sequence == first.sequence + 7);
  const LeverReading gap = lever.read(start + 3'600'000 * kMillisecond);
  CHECK(gap.sequence == first.sequence + 7 + kMaxPeriodsPerRead);
  CHECK(lever.read(start + 3'600'001 * kMillisecond).sequence == gap.sequence + 1);
}

TEST_CASE("one read after ten periods equals ten reads after one each") {
  Bench once(exact(kGripHand), hand_at({0.02, 0.03})), each(exact(kGripHand), hand_at({0.02, 0.03}));
  each.run(10);
  once.reading = once.lever.read(10 * kMillisecond);
  CHECK(once.reading.position == each.reading.position);
  CHECK(once.reading.hand_force == each.reading.hand_force);
}

TEST_CASE("whatever the driver and the loop send, the reading is finite and inside the stops") {
  const double bad[] = {kNan, kInfinity, -kInfinity, 1e308, -1e308, 0.2, 1e-320};
  SimulatedLeverConfig config;
  config.hand = kGripHand;
  Bench bench(config, {});
  for (double a : bad) {
    for (double b : bad) {
      bench.hand.target = {{a, b}, {b, a}, {a, a}, false, false};
      bench.lever.write({b, a});
      bench.lever.place({a, b});
      for (int i = 0; i < 20; ++i) {
        bench.run(1);
        const LeverReading& r = bench.reading;
        CHECK(glm::length(r.position) < 0.120);
        CHECK(std::isfinite(glm::length(r.hand_force) + glm::length(r.actuator_force)));
        CHECK(std::abs(bench.arc().x) <= 0.120 * kYoke.theta_limit * (1.0 + 1e-12));
        CHECK(std::abs(bench.arc().y) <= 0.120 * kYoke.phi_limit * (1.0 + 1e-12));
      }
    }
  }
  bench.hand.target = {};
  bench.lever.release();
  bench.run(3000);
  CHECK(glm::length(bench.lever.true_position()) < 1e-6);  // it recovers fully
}

TEST_CASE("the sensor's noise has the stated deviation, and the seed decides every bit of it") {
  SimulatedLeverConfig config = exact();
  config.force_sensor.noise_gw = 20.0;
  Bench a(config, {}), b(config, {});
  config.seed = 2;
  Bench other(config, {});
  double sum = 0.0, squares = 0.0;
  const int n = 20'000;
  bool differs = false;
  for (int i = 0; i < n; ++i) {
    a.run(1), b.run(1), other.run(1);
    CHECK(a.reading.hand_force == b.reading.hand_force);
    differs = differs || a.reading.hand_force != other.reading.hand_force;
    sum += a.reading.hand_force.x;
    squares += a.reading.hand_force.x * a.reading.hand_force.x;
  }
  const double deviation = 20.0 * 9.80665e-3;
  CHECK(differs);
  CHECK(std::abs(sum / n) < 4.0 * deviation / std::sqrt(n));
  CHECK(std::sqrt(squares / n) == doctest::Approx(deviation).epsilon(4.0 / std::sqrt(2.0 * n)));
}

TEST_CASE("a bad value is refused in one sentence with parameter, value and allowed range") {
  SimulatedLeverConfig config;
  CHECK(refusal(config) == "accepted");
  CHECK(refusal(config, 0) == "period_ns = 0: must be between 1 and 1000000000");
  config.delay = 9;
  CHECK(refusal(config) == "lever.delay_cycles = 9: must be between 0 and 8");
  config = {};
  config.device_wall_stiffness = -1.0;
  CHECK(refusal(config) == "lever.own_wall_stiffness_n_per_m = -1: must be between 0 and 100000");
  config = {};
  config.axis_x.mass = 0.0;
  CHECK(refusal(config) == "lever.axis_x.mass_kg = 0: must be between 0.001 and 1000");
  config = {};
  config.axis_y.damping = kNan;
  CHECK(refusal(config) == "lever.axis_y.damping_n_s_per_m = nan: must be between 0 and 10000");
  config = {};
  config.hand.stiffness = -1.0;
  CHECK(refusal(config) == "lever.hand.stiffness_n_per_m = -1: must be between 0 and 1000000");
  config = {};
  config.encoder_counts = kInfinity;
  CHECK(refusal(config) == "lever.encoder_counts_per_deg = inf: must be between 0 and 1000000");
  config = {};
  config.actuator.continuous_force = 40.0;
  CHECK(refusal(config) == "lever.continuous_force_n = 40: must be between 0 and 31.7");
}
