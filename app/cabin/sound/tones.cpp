// This work is based on:
// Kees van den Doel, Paul Kry, Dinesh Pai. FoleyAutomatic: Physically-based Sound Effects for Interactive Simulation and
// Animation. 2001: a struck body sounds as a sum of damped sines
#include "app/cabin/sound/tones.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/sound/sound_world.h"

namespace gearshift::cabin {

std::size_t samples_in(double seconds) noexcept {
  return static_cast<std::size_t>(std::lround(seconds * engine::kSoundRate));
}

double seconds_at(std::size_t sample) noexcept {
  return static_cast<double>(sample) / engine::kSoundRate;
}

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

}  // namespace gearshift::cabin
