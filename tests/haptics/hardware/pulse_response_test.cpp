// Tests of fit_pulses() against responses in closed form.
#include "haptics/hardware/pulse_response.h"

#include <cmath>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

using namespace gearshift::haptics;

namespace {

// Responses to a unit step of acceleration from rest. They solve x'' + b x' + k x = 1, with damping b and stiffness k
// per mass, and were derived by hand.
double sliding(double b, double t) {  // no stiffness (k = 0)
  return t <= 0.0 ? 0.0 : (t - (1.0 - std::exp(-b * t)) / b) / b;
}
double swinging(double b, double k, double t) {  // underdamped: b^2 < 4 k
  if (t <= 0.0) return 0.0;
  const double a = 0.5 * b, w = std::sqrt(k - a * a);
  return (1.0 - std::exp(-a * t) * (std::cos(w * t) + a / w * std::sin(w * t))) / k;
}
double creeping(double b, double k, double t) {  // overdamped: b^2 > 4 k
  if (t <= 0.0) return 0.0;
  const double root = std::sqrt(0.25 * b * b - k), fast = 0.5 * b + root, slow = 0.5 * b - root;
  return (1.0 - (fast * std::exp(-slow * t) - slow * std::exp(-fast * t)) / (fast - slow)) / k;
}

std::vector<Pulse> pulses_of(const auto& step, double gain, double delay, double quantum) {
  std::vector<Pulse> pulses;
  for (const double magnitude : {0.05, -0.05, 0.10}) {
    constexpr double kLength = 0.060;
    Pulse pulse;
    pulse.steps = {{0.0, magnitude}, {kLength, 0.0}};
    for (int ms = 0; ms < 460; ++ms) {
      const double since = 1e-3 * ms - delay;
      const double x = magnitude * gain * (step(since) - step(since - kLength));
      pulse.samples.push_back({1e-3 * ms, quantum > 0.0 ? quantum * std::round(x / quantum) : x});
    }
    pulses.push_back(pulse);
  }
  return pulses;
}

}  // namespace

TEST_CASE("the exact response gives the exact parameters: without spring, underdamped, overdamped, at any delay") {
  for (const double delay : {0.0, 0.0013, 0.045}) {
    CAPTURE(delay);
    const double gain = 1e5;
    const PulseFit slides = fit_pulses(pulses_of([](double t) { return sliding(32.0, t); }, gain, delay, 0.0));
    CHECK(slides.gain == doctest::Approx(gain).epsilon(1e-4));
    CHECK(slides.damping == doctest::Approx(32.0).epsilon(1e-3));
    CHECK(std::abs(slides.stiffness) < 0.1);
    CHECK(std::abs(slides.delay - delay) < 2e-6);
    const PulseFit swings = fit_pulses(pulses_of([](double t) { return swinging(8.0, 4000.0, t); }, gain, delay, 0.0));
    CHECK(swings.gain == doctest::Approx(gain).epsilon(1e-4));
    CHECK(swings.damping == doctest::Approx(8.0).epsilon(1e-3));
    CHECK(swings.stiffness == doctest::Approx(4000.0).epsilon(1e-3));
    CHECK(std::abs(swings.delay - delay) < 2e-6);
    // The paper's X axis has 0.095 kg, 3 N s/m and 14.8 N/m, so per mass its damping is 31.58 1/s and its stiffness
    // 155.8 1/s^2.
    const PulseFit paper = fit_pulses(pulses_of([](double t) { return creeping(31.58, 155.8, t); }, gain, delay, 0.0));
    CHECK(paper.gain == doctest::Approx(gain).epsilon(1e-4));
    CHECK(paper.damping == doctest::Approx(31.58).epsilon(1e-3));
    CHECK(paper.stiffness == doctest::Approx(155.8).epsilon(1e-3));
    CHECK(paper.residual < 1e-4);
  }
}

TEST_CASE("with the counts of a coarse stick: delay within 0.1 ms, the rest within a few percent") {
  const PulseFit fit = fit_pulses(pulses_of([](double t) { return creeping(31.58, 155.8, t); }, 7e5, 0.004, 1.0));
  CHECK(fit.gain == doctest::Approx(7e5).epsilon(0.02));
  CHECK(fit.damping == doctest::Approx(31.58).epsilon(0.03));
  CHECK(fit.stiffness == doctest::Approx(155.8).epsilon(0.10));
  CHECK(std::abs(fit.delay - 0.004) < 2e-4);
}

namespace {

// Pulses on a lever with dry friction, as another program would simulate them: in steps of 2 us.
std::vector<Pulse> rubbed_pulses(double b, double k, double friction, double gain, double quantum) {
  constexpr double kStep = 2e-6, kLength = 0.060;
  std::vector<Pulse> pulses;
  for (const double magnitude : {0.05, -0.05, 0.05, -0.05}) {
    Pulse pulse;
    pulse.steps = {{0.0, magnitude}, {kLength, 0.0}};
    double x = 0.0, v = 0.0;
    for (int n = 0; n < 230'000; ++n) {
      if (n % 500 == 0) pulse.samples.push_back({n * kStep, quantum > 0.0 ? quantum * std::round(x / quantum) : x});
      const double force = gain * (n * kStep < kLength ? magnitude : 0.0);
      const double free = v + kStep * (force - b * v - k * x), lost = kStep * gain * friction, old = v;
      v = std::abs(free) <= lost ? 0.0 : free - std::copysign(lost, free);
      x += 0.5 * kStep * (old + v);
    }
    pulses.push_back(pulse);
  }
  return pulses;
}

}  // namespace

TEST_CASE("dry friction of a separately simulated lever is found, and does not count as damping") {
  // 20 N at full force on 0.095 kg with 3 N s/m and 14.8 N/m, or on a light handle with little damping.
  for (const std::pair<double, double>& handle : {std::pair{31.58, 155.8}, {5.0, 400.0}}) {
    const double damping = handle.first, stiffness = handle.second;
    for (const double friction : {0.0, 0.11 / 20.0, 0.4 / 20.0}) {
      for (const double quantum : {0.0, 0.1}) {
        CAPTURE(damping);
        CAPTURE(friction);
        CAPTURE(quantum);
        const PulseFit fit = fit_pulses(rubbed_pulses(damping, stiffness, friction, 2e6, quantum));
        CHECK(fit.gain == doctest::Approx(2e6).epsilon(0.01));
        CHECK(std::abs(fit.damping - damping) < 0.02 * damping + 0.1);
        CHECK(std::abs(fit.friction - friction) < 0.02 * friction + 1e-4);
        CHECK(std::abs(fit.delay) < 1e-4);
      }
    }
  }
}

TEST_CASE("a different motion leaves a large residual; no motion is refused") {
  std::vector<Pulse> pulses = pulses_of([](double t) { return sliding(32.0, t); }, 1e5, 0.0, 0.0);
  std::mt19937 chance(5);
  std::normal_distribution<double> noise(0.0, 100.0);
  for (Pulse& pulse : pulses)
    for (PulseSample& sample : pulse.samples) sample.position = noise(chance);
  CHECK(fit_pulses(pulses).residual > 0.9);
  for (Pulse& pulse : pulses)
    for (PulseSample& sample : pulse.samples) sample.position = 0.0;
  CHECK_THROWS_WITH_AS(fit_pulses(pulses), "the lever did not move", std::invalid_argument);
  CHECK_THROWS_AS(fit_pulses({}), std::invalid_argument);
}
