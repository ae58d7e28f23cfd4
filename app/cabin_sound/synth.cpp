// This work is based on:
// Kees van den Doel, Paul Kry, Dinesh Pai. FoleyAutomatic: Physically-based Sound Effects for Interactive Simulation and
// Animation. 2001: a struck body sounds as a sum of damped sines
#include "app/cabin_sound/synth.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <span>

#include "app/cabin_sound/noise.h"
#include "engine/sound/sound_world.h"

namespace gearshift {

namespace {

struct Mode {
  double frequency;  // [Hz]
  double decay;      // [s] to 1/e
  double amplitude;
};

std::size_t samples_in(double seconds) {
  return static_cast<std::size_t>(std::lround(seconds * kSoundRate));
}

double seconds_at(std::size_t n) {
  return static_cast<double>(n) / kSoundRate;
}

// Sines begin at 0, so that a strike has no step.
void strike(std::vector<float>& out, double start, double strength, std::initializer_list<Mode> modes) {
  const std::size_t first = samples_in(start);
  for (std::size_t n = first; n < out.size(); ++n) {
    const double t = seconds_at(n - first);
    double sum = 0.0;
    for (const Mode& mode : modes) {
      sum += mode.amplitude * std::exp(-t / mode.decay) * std::sin(2.0 * std::numbers::pi * mode.frequency * t);
    }
    out[n] += static_cast<float>(strength * sum);
  }
}

void fade_out(std::vector<float>& out, double seconds) {
  const std::size_t count = samples_in(seconds);
  for (std::size_t n = 0; n < count; ++n) out[out.size() - 1 - n] *= static_cast<float>(n) / static_cast<float>(count);
}

void normalise(std::vector<float>& out, float peak) {
  float highest = 0.0f;
  for (const float x : out) highest = std::max(highest, std::abs(x));
  for (float& x : out) x *= peak / highest;
}

// 5 ms of raised cosine at each end; a second harmonic makes it easier to tell where it comes from.
void tone(std::vector<float>& out, double start, double length, double frequency) {
  constexpr double kEdge = 0.005, kSecond = 0.15;
  const std::size_t first = samples_in(start), count = samples_in(length);
  for (std::size_t n = 0; n < count; ++n) {
    const double t = seconds_at(n);
    const double from_end = std::min({t, length - t, kEdge});
    const double edge = 0.5 - 0.5 * std::cos(std::numbers::pi * from_end / kEdge);
    const double phase = 2.0 * std::numbers::pi * frequency * t;
    out[first + n] += static_cast<float>(edge * (std::sin(phase) + kSecond * std::sin(2.0 * phase)));
  }
}

}  // namespace

std::vector<float> wall_knock() {
  std::vector<float> out(samples_in(0.16));
  strike(out, 0.0, 1.0,
         {{170.0, 0.030, 1.0}, {430.0, 0.022, 0.8}, {960.0, 0.014, 0.6}, {1830.0, 0.008, 0.4}, {3300.0, 0.004, 0.3}});
  fade_out(out, 0.01);
  normalise(out, 0.95f);
  return out;
}

std::vector<float> gear_in_click() {
  std::vector<float> out(samples_in(0.14));
  strike(out, 0.0, 0.5, {{820.0, 0.010, 1.0}, {2150.0, 0.006, 0.7}, {4100.0, 0.003, 0.4}});
  strike(out, 0.016, 1.0, {{260.0, 0.024, 1.0}, {690.0, 0.016, 0.7}, {1900.0, 0.007, 0.5}});
  fade_out(out, 0.01);
  normalise(out, 0.55f);
  return out;
}

std::vector<float> gear_out_click() {
  std::vector<float> out(samples_in(0.08));
  strike(out, 0.0, 1.0, {{610.0, 0.012, 1.0}, {1750.0, 0.007, 0.7}, {3600.0, 0.003, 0.4}});
  fade_out(out, 0.01);
  normalise(out, 0.4f);
  return out;
}

// Noise of the teeth' ringing, let through 45 times a second, no tooth quite like the other.
std::vector<float> grind_loop() {
  constexpr std::size_t kTeeth = 45;
  constexpr double kRise = 0.03, kFall = 0.3;  // [1] of the time between two teeth
  std::vector<float> out = looping_noise(static_cast<std::size_t>(kSoundRate), 1);
  loop_high_pass(out, 700.0);
  loop_low_pass(out, 3500.0);
  Noise strengths(2);
  float strength = 0.0f;
  std::size_t tooth = kTeeth;
  for (std::size_t n = 0; n < out.size(); ++n) {
    if (n * kTeeth / out.size() != tooth) {
      tooth = n * kTeeth / out.size();
      strength = 0.75f + 0.25f * strengths.next();
    }
    const double phase = static_cast<double>(n * kTeeth % out.size()) / static_cast<double>(out.size());
    const double gate = std::min(phase / kRise, 1.0) * std::exp(-phase / kFall);
    out[n] = std::tanh(8.0f * strength * static_cast<float>(gate) * out[n]);  // a rattle is harder than noise
  }
  normalise(out, 0.9f);
  return out;
}

std::vector<float> over_push_loop() {
  constexpr double kEach = 0.2;  // [s]
  std::vector<float> out(samples_in(2.0 * kEach));
  for (const int n : {0, 1}) tone(out, n * kEach, kEach, kOverPushTones[n]);
  normalise(out, 0.9f);
  return out;
}

std::vector<float> saturation_loop() {
  std::vector<float> out(samples_in(0.5));
  for (const int n : {0, 1, 2}) tone(out, n * 0.11, 0.06, kSaturationTone);
  normalise(out, 0.9f);
  return out;
}

}  // namespace gearshift
