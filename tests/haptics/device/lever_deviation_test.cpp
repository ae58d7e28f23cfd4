// Tests of the simulated lever's deviations from its model: period jitter and parameter errors.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>

#include <doctest/doctest.h>
#include <glm/vec2.hpp>

#include "haptics/device/simulated_lever.h"
#include "tests/haptics/device/still_hand.h"

using namespace gearshift::haptics;
using namespace gearshift::test;

namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr YokeGeometry kLeverYoke;

SimulatedLeverConfig without_noise() {
  SimulatedLeverConfig config;
  config.encoder_counts = 0.0;
  config.force_sensor.resolution_gw = 0.0;
  return config;
}

glm::dvec2 arc_of(const SimulatedLever& lever) {
  return arc_position(kLeverYoke, joint_angles_from_plane(kLeverYoke, lever.true_position()));
}

// A hand driver that only records the time of its last call.
class Clock final : public HandDriver {
 public:
  HandTarget next(double time, glm::dvec2) noexcept override {
    asked_time = time;
    return {};
  }
  double asked_time = 0.0;
};

// Parameters measured on the lever. Stiffness k: from the rest position x0 under a constant force. Mass m: from the
// first time step under this force. Damping b: from the return after the force is released, by b x0 = k (integral of
// x), because the total impulse of spring and damper is zero.
struct Measured {
  double mass, damping, stiffness;
};

template <int kAxis>
Measured measure(const SimulatedLeverConfig& config) {
  constexpr std::int64_t kStep = 100'000;  // [ns]
  StillHand hand;
  SimulatedLever lever(config, kStep, hand);
  std::int64_t now = 0;
  lever.read(now);
  glm::dvec2 force{0.0};
  force[kAxis] = 0.3;
  lever.write(force);
  lever.read(now += kStep);
  const double first = arc_of(lever)[kAxis];
  while (now < 20'000'000'000) lever.read(now += 1000 * kStep);
  const double rest = arc_of(lever)[kAxis];
  const double held = force[kAxis] * std::cos(rest / kLeverYoke.radius);  // along the arc

  lever.release();
  double integral = 0.0, previous = rest;
  for (int i = 0; i < 100'000; ++i) {
    lever.read(now += kStep);
    const double middle = arc_of(lever)[kAxis];
    lever.read(now += kStep);
    const double after = arc_of(lever)[kAxis];
    integral += (previous + 4.0 * middle + after) * 1e-9 * kStep / 3.0;
    previous = after;
  }
  const double stiffness = held / rest, t = 1e-9 * kStep;
  const double damping = stiffness * integral / rest;
  // Soon after a force f is applied, x = f t^2 / (2 m) (1 - b t / (3 m)), with mass m and damping b.
  double mass = 0.1;
  for (int i = 0; i < 5; ++i) mass = force[kAxis] * t * t / (2.0 * first) * (1.0 - damping * t / (3.0 * mass));
  return {mass, damping, stiffness};
}

void check_off(double measured, double nominal) {
  CHECK(std::abs(measured / nominal - 1.0) < 0.2);
  CHECK(std::abs(measured / nominal - 1.0) > 1e-3);  // a random error is below 1e-3 in 1 of 200 draws
}

}  // namespace

TEST_CASE("uneven periods: at every reported time the lever is where the closed form puts it") {
  SimulatedLeverConfig config = without_noise();
  config.period_jitter = 0.3;
  Clock clock;
  SimulatedLever lever(config, kMs, clock);
  std::int64_t now = 5'000'000'000;
  const LeverReading first = lever.read(now);
  CHECK(first.time_ns == now);
  lever.place({0.03, -0.02});
  const glm::dvec2 start = arc_of(lever);
  double shortest = 1.0, longest = 0.0;
  std::int64_t last = first.time_ns;
  for (std::uint64_t n = 1; n <= 2000; ++n) {
    const LeverReading reading = lever.read(now += kMs);
    CHECK(reading.sequence == first.sequence + n);
    CHECK(clock.asked_time == doctest::Approx(1e-9 * static_cast<double>(last - first.time_ns)).epsilon(1e-12));
    const double length = 1e-9 * static_cast<double>(reading.time_ns - last);
    shortest = std::min(shortest, length), longest = std::max(longest, length);
    last = reading.time_ns;

    const double time = 1e-9 * static_cast<double>(reading.time_ns - first.time_ns);
    const glm::dvec2 arc = arc_of(lever);
    const AxisState x = advance(config.axis_x, {start.x, 0.0}, 0.0, time);
    const AxisState y = advance(config.axis_y, {start.y, 0.0}, 0.0, time);
    CHECK(std::abs(arc.x - x.position) < 1e-13);
    CHECK(std::abs(arc.y - y.position) < 1e-13);
  }
  CHECK((shortest >= 0.7e-3 && shortest < 0.705e-3));
  CHECK((longest <= 1.3e-3 && longest > 1.295e-3));
}

TEST_CASE("uneven periods under dry friction and at the stop: the same motion as one long step") {
  SimulatedLeverConfig config = without_noise();
  config.period_jitter = 0.5;
  config.coulomb_friction = 0.4;
  StillHand hand(hand_pushing({0.9, 0.0}));
  SimulatedLever lever(config, kMs, hand);
  const LeverReading first = lever.read(0);
  AxisState expected{0.0, 0.0};
  std::int64_t last = first.time_ns;
  for (std::int64_t n = 1; n <= 500; ++n) {
    const double along = hand.target.push.x * std::cos(arc_of(lever).x / kLeverYoke.radius);
    const LeverReading reading = lever.read(n * kMs);
    const AxisLimits limits{kLeverYoke.radius * kLeverYoke.theta_limit, config.coulomb_friction};
    const double length = 1e-9 * static_cast<double>(reading.time_ns - last);
    expected = advance_limited(config.axis_x, limits, expected, along, length);
    last = reading.time_ns;
    CHECK(std::abs(arc_of(lever).x - expected.position) < 1e-13);
  }
}

TEST_CASE("the seed determines every period, and one long gap equals its single periods") {
  SimulatedLeverConfig config;
  config.period_jitter = 0.1;
  StillHand hand;
  SimulatedLever each(config, kMs, hand), once(config, kMs, hand);
  config.seed = 2;
  SimulatedLever other(config, kMs, hand);
  each.read(0), once.read(0), other.read(0);
  for (std::int64_t n = 1; n <= 50; ++n) each.read(n * kMs);
  const LeverReading a = each.read(51 * kMs), b = once.read(51 * kMs);
  CHECK(a.time_ns == b.time_ns);
  CHECK(a.sequence == b.sequence);
  CHECK(a.position == b.position);
  CHECK(other.read(51 * kMs).time_ns != a.time_ns);
}

TEST_CASE("model error of 20 %: measured parameters differ from spec(), within 20 %, depending on the seed") {
  SimulatedLeverConfig config = without_noise();
  config.model_error = 0.2;
  double last_mass = 0.0;
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    config.seed = seed;
    StillHand hand;
    CHECK(SimulatedLever(config, kMs, hand).spec().axis_x.mass == config.axis_x.mass);
    const Measured x = measure<0>(config), y = measure<1>(config);
    check_off(x.mass, config.axis_x.mass), check_off(y.mass, config.axis_y.mass);
    check_off(x.damping, config.axis_x.damping), check_off(y.damping, config.axis_y.damping);
    check_off(x.stiffness, config.axis_x.stiffness), check_off(y.stiffness, config.axis_y.stiffness);
    CHECK(std::abs(x.mass / config.axis_x.mass - y.mass / config.axis_y.mass) > 1e-4);
    CHECK(std::abs(x.mass - last_mass) > 1e-5);
    last_mass = x.mass;
  }
  config.model_error = 0.0;
  const Measured even = measure<0>(config);
  CHECK(even.mass == doctest::Approx(0.095).epsilon(1e-4));
  CHECK(even.damping == doctest::Approx(3.0).epsilon(1e-4));
  CHECK(even.stiffness == doctest::Approx(14.8).epsilon(1e-4));
}

TEST_CASE("errors and jitter out of range are refused") {
  const auto refusal = [](double error, double jitter) -> std::string {
    SimulatedLeverConfig config;
    config.model_error = error;
    config.period_jitter = jitter;
    StillHand hand;
    try {
      SimulatedLever(config, kMs, hand);
    } catch (const std::invalid_argument& refused) {
      return refused.what();
    }
    return "accepted";
  };
  CHECK(refusal(0.5, 0.5) == "accepted");
  CHECK(refusal(0.6, 0.0) == "lever.model_error = 0.6: must be between 0 and 0.5");
  CHECK(refusal(0.0, -0.1) == "lever.period_jitter = -0.1: must be between 0 and 0.5");
  CHECK(refusal(std::nan(""), 0.0) == "lever.model_error = nan: must be between 0 and 0.5");
}
