#include "app/cabin/sound/engine_synth.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "app/cabin/sound/noise.h"
#include "engine/sound/sound_world.h"

namespace gearshift::cabin {

namespace {

constexpr double kTau = 2.0 * std::numbers::pi;
constexpr std::size_t kCycles = 40;  // number of engine cycles per loop: 2 s, enough to hide that the noise repeats
constexpr std::size_t kCycleSamples = static_cast<std::size_t>(engine::kSoundRate * 120.0 / kEngineLoopSpeed);
constexpr double kMaxFrequency = 4000.0;  // [Hz] highest frequency heard at the engine speed of the band
constexpr std::array<double, kEngineBands.size()> kLevels = {0.10, 0.14, 0.18, 0.22};  // RMS of the tone at full load

// The frequency heard at the band's own engine speed, divided by the frequency in the loop.
double audible_per_loop_hertz(std::size_t band) {
  return kEngineBands[band] / kEngineLoopSpeed;
}

// [Hz] Highest frequency allowed in the loop. It is heard at kMaxFrequency or lower, and does not alias at the highest
// pitch of this band.
double loop_limit(std::size_t band) {
  const double fastest = band + 1 < kEngineBands.size() ? kEngineBands[band + 1] : 8000.0;
  return std::min(kMaxFrequency / audible_per_loop_hertz(band), 0.45 * engine::kSoundRate * kEngineLoopSpeed / fastest);
}

// Amplitude of an order (multiple of the engine cycle's frequency) in a pulse train with one pulse per cylinder. It is
// about 1 if the order is a multiple of the number of cylinders. The other orders come only from differences between
// the cylinders, like the half orders of a real engine.
double pulse_train(int order, int cylinders) {
  constexpr float kSpread = 0.12f;
  Noise strengths(7);
  std::complex<double> sum = 0.0;
  for (int n = 0; n < cylinders; ++n) {
    const double strength = 1.0 + kSpread * strengths.next();
    sum += std::polar(strength, -kTau * order * n / cylinders);
  }
  return std::abs(sum) / cylinders;
}

// Gain of the resonances of body panels and exhaust. From each harmonic of the firing frequency to the next, the pulse
// train loses more than this gain adds. The firing frequency therefore stays strongest.
double resonances(double hertz) {
  const auto bump = [hertz](double centre, double gain) {
    const double octaves = std::log2(hertz / centre) / 0.35;
    return gain * std::exp(-octaves * octaves);
  };
  return 1.0 + bump(125.0, 0.25) + bump(310.0, 0.3) + bump(640.0, 0.3) + bump(1500.0, 0.4);
}

// Gain of the bulkhead's low pass: the sound is muffled when coasting; full throttle raises the corner frequency and
// the level.
double throttle_filter(double hertz, EngineLoad load) {
  constexpr double kCoasting = 0.3;
  if (load == EngineLoad::full) return std::pow(1.0 + std::pow(hertz / 450.0, 2.0), -0.9);
  return kCoasting * std::pow(1.0 + std::pow(hertz / 220.0, 2.0), -1.1);
}

double partial(int order, int cylinders, std::size_t band, EngineLoad load) {
  const double hertz = order * kEngineBands[band] / 120.0;
  const double pulse = std::min(1.0, std::pow(static_cast<double>(cylinders) / order, 0.7));
  return pulse_train(order, cylinders) * pulse * resonances(hertz) * throttle_filter(hertz, load);
}

// RMS of the full-load tone before its level is set. The powers of partials of different orders add up.
double full_tone_rms(int cylinders, std::size_t band, int orders) {
  double power = 0.0;
  for (int order = 1; order <= orders; ++order) {
    power += 0.5 * std::pow(partial(order, cylinders, band, EngineLoad::full), 2.0);
  }
  return std::sqrt(power);
}

// A table with one period of a sine; for order k, the caller advances k entries per sample.
std::array<double, kCycleSamples> sine_of_cycle() {
  std::array<double, kCycleSamples> table{};
  for (std::size_t n = 0; n < table.size(); ++n) table[n] = std::sin(kTau * static_cast<double>(n) / kCycleSamples);
  return table;
}

// The tone of one engine cycle. Its phases are random but the same in every loop.
std::vector<double> tone_cycle(int cylinders, std::size_t band, EngineLoad load) {
  static const auto sine = sine_of_cycle();
  const int orders = static_cast<int>(loop_limit(band) * 120.0 / kEngineLoopSpeed);
  const double level = kLevels[band] / full_tone_rms(cylinders, band, orders);
  std::vector<double> cycle(kCycleSamples);
  Noise phases(3);
  for (int order = 1; order <= orders; ++order) {
    const double amplitude = level * partial(order, cylinders, band, load);
    auto at = static_cast<std::size_t>((0.5 + 0.5 * phases.next()) * kCycleSamples) % kCycleSamples;
    for (double& x : cycle) {
      x += amplitude * sine[at];
      at = (at + static_cast<std::size_t>(order)) % kCycleSamples;
    }
  }
  return cycle;
}

// The noise of intake and exhaust, modulated by the firings. All loops use the same seed, so that their noise also
// mixes in phase.
std::vector<float> rush(int cylinders, std::size_t band, EngineLoad load) {
  const bool is_full = load == EngineLoad::full;
  const double to_loop = 1.0 / audible_per_loop_hertz(band);
  std::vector<float> out = looping_noise(kCycles * kCycleSamples, 11);
  loop_high_pass(out, 150.0 * to_loop);
  for (int n = 0; n < 2; ++n) loop_low_pass(out, 600.0 * to_loop);
  const double gain = kLevels[band] * (is_full ? 0.9 : 0.25);
  for (std::size_t n = 0; n < out.size(); ++n) {
    const double turn = static_cast<double>(n % kCycleSamples) / kCycleSamples;
    out[n] *= static_cast<float>(gain * (0.6 + 0.4 * std::cos(kTau * cylinders * turn)));
  }
  return out;
}

}  // namespace

std::vector<float> engine_loop(int cylinders, std::size_t band, EngineLoad load) {
  const std::vector<double> cycle = tone_cycle(cylinders, band, load);
  std::vector<float> out = rush(cylinders, band, load);
  for (std::size_t n = 0; n < out.size(); ++n) out[n] += static_cast<float>(cycle[n % kCycleSamples]);
  return out;
}

std::array<double, kEngineBands.size()> band_weights(double speed) {
  std::array<double, kEngineBands.size()> weights{};
  std::size_t upper = 0;
  while (upper < kEngineBands.size() && kEngineBands[upper] <= speed) ++upper;
  if (upper == 0 || upper == kEngineBands.size()) {
    weights[upper == 0 ? 0 : upper - 1] = 1.0;
    return weights;
  }
  const double low = kEngineBands[upper - 1], high = kEngineBands[upper];
  weights[upper] = std::log(speed / low) / std::log(high / low);
  weights[upper - 1] = 1.0 - weights[upper];
  return weights;
}

}  // namespace gearshift::cabin
