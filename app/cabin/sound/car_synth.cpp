#include "app/cabin/sound/car_synth.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>

#include "app/cabin/sound/noise.h"
#include "app/cabin/sound/tones.h"
#include "engine/sound/sound_world.h"

namespace gearshift::cabin {

namespace {

constexpr double kFiringsAt1Rpm = 2.0 / 60.0;  // [Hz] four-cylinder firing rate per 1/min of engine speed

struct Partial {
  double frequency;  // [Hz] the loop must contain a whole number of periods
  double amplitude;
};

void add_partials(std::vector<float>& loop, std::initializer_list<Partial> partials) {
  for (const auto& [frequency, amplitude] : partials) {
    for (std::size_t n = 0; n < loop.size(); ++n) {
      loop[n] += static_cast<float>(amplitude * std::sin(2.0 * std::numbers::pi * frequency * seconds_at(n)));
    }
  }
}

// Position of sample n between two beats, 0 to 1, in a loop with `count` beats and `size` samples.
double phase_of(std::size_t n, std::size_t count, std::size_t size) {
  return static_cast<double>(n * count % size) / static_cast<double>(size);
}

// Envelope that rises at the beat and then decays. `rise` and `fall`: durations as fractions of the beat period [1].
double beat(double phase, double rise, double fall) {
  return std::min(phase / rise, 1.0) * std::exp(-phase / fall);
}

// A loop with the same strike at every beat; the tail of the last strike wraps around to the beginning of the loop.
std::vector<float> repeated_strikes(std::size_t size, std::size_t beats, std::initializer_list<Mode> modes) {
  constexpr double kTail = 0.3;  // [s] after this time the slowest mode has decayed to exp(-10)
  std::vector<float> hit(samples_in(kTail)), out(size);
  strike(hit, 0.0, 1.0, modes);
  fade_out(hit, 0.05);
  for (std::size_t beat = 0; beat < beats; ++beat) {
    for (std::size_t n = 0; n < hit.size(); ++n) out[(beat * size / beats + n) % size] += hit[n];
  }
  return out;
}

}  // namespace

// Noise bursts, one per tooth, whose strength varies from tooth to tooth.
std::vector<float> grind_loop() {
  constexpr auto kTeeth = static_cast<std::size_t>(kGrindLoopRate);  // number of teeth in the loop of 1 s
  constexpr double kRise = 0.05, kFall = 0.3;
  std::vector<float> out = looping_noise(samples_in(1.0), 1);
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
    const auto gate = static_cast<float>(beat(phase_of(n, kTeeth, out.size()), kRise, kFall));
    out[n] = std::tanh(8.0f * strength * gate * out[n]);  // distortion makes the noise sound like a rattle
  }
  normalise(out, 0.9f);
  return out;
}

std::vector<float> starter_loop() {
  constexpr double kLength = 2.0;  // [s]
  constexpr double kWhine = kStarterLoopSpeed / 60.0 * kRingTeeth;
  const auto beats = static_cast<std::size_t>(std::lround(kLength * kStarterLoopSpeed * kFiringsAt1Rpm));
  std::vector<float> out(samples_in(kLength));
  add_partials(out, {{kWhine, 1.0}, {2.0 * kWhine, 0.45}, {3.0 * kWhine, 0.25}});
  std::vector<float> brushes = looping_noise(out.size(), 21);
  loop_high_pass(brushes, 800.0);
  loop_low_pass(brushes, 2500.0);
  const std::vector<float> thumps = repeated_strikes(out.size(), beats, {{70.0, 0.030, 0.9}, {115.0, 0.020, 0.5}});
  for (std::size_t n = 0; n < out.size(); ++n) {
    const double held = std::cos(2.0 * std::numbers::pi * phase_of(n, beats, out.size()));
    out[n] = (out[n] + 0.8f * brushes[n]) * static_cast<float>(0.65 + 0.35 * held) + thumps[n];
  }
  normalise(out, 0.9f);
  return out;
}

std::vector<float> judder_loop() {
  constexpr double kLength = 1.5;  // [s]
  const auto beats = static_cast<std::size_t>(std::lround(kLength * kJudderLoopSpeed * kFiringsAt1Rpm));
  std::vector<float> out(samples_in(kLength));
  add_partials(out,
               {{kJudderTone, 1.0}, {2.0 * kJudderTone, 0.6}, {3.0 * kJudderTone, 0.4}, {4.0 * kJudderTone, 0.25}});
  for (std::size_t n = 0; n < out.size(); ++n) {
    const double swing = 0.5 + 0.5 * std::cos(2.0 * std::numbers::pi * phase_of(n, beats, out.size()));
    out[n] *= static_cast<float>(0.1 + 0.9 * swing);
  }
  normalise(out, 0.9f);
  return out;
}

std::vector<float> limiter_loop() {
  constexpr auto kPops = static_cast<std::size_t>(kLimiterRate);  // number of pops in the loop of 1 s
  std::vector<float> out = looping_noise(samples_in(1.0), 31);
  loop_high_pass(out, 200.0);
  loop_low_pass(out, 1200.0);
  const std::vector<float> thumps = repeated_strikes(out.size(), kPops, {{95.0, 0.012, 0.5}, {240.0, 0.008, 0.4}});
  for (std::size_t n = 0; n < out.size(); ++n) {
    const double gate = beat(phase_of(n, kPops, out.size()), 0.02, 0.15);
    out[n] = static_cast<float>(2.0 * gate) * out[n] + thumps[n];
  }
  normalise(out, 0.9f);
  return out;
}

std::vector<float> over_rev_loop() {
  constexpr double kPeriod = 1.0 / kOverRevRate;
  std::vector<float> out(samples_in(kPeriod));
  tone(out, 0.0, 0.5 * kPeriod, kOverRevTone);
  normalise(out, 0.9f);
  return out;
}

std::vector<float> stall_chime() {
  constexpr double kApart = 0.22;  // [s] time between the two bells
  std::vector<float> out(samples_in(1.2));
  for (const int n : {0, 1}) {
    const double f = kStallTones[n];
    strike(out, n * kApart, 1.0, {{f, 0.30, 1.0}, {2.0 * f, 0.12, 0.3}, {3.01 * f, 0.05, 0.15}});
  }
  fade_out(out, 0.2);
  normalise(out, 0.7f);
  return out;
}

std::vector<float> bite_tick() {
  std::vector<float> out(samples_in(0.12));
  strike(out, 0.0, 1.0, {{kBiteTone, 0.02, 1.0}, {2.7 * kBiteTone, 0.008, 0.4}});
  fade_out(out, 0.02);
  normalise(out, 0.7f);
  return out;
}

}  // namespace gearshift::cabin
