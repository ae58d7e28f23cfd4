// This work is based on:
// Guy Steele, Doug Lea, Christine Flood. Fast Splittable Pseudorandom Number Generators. 2014: SplitMix64, Figure 16
#include "app/cabin/sound/noise.h"

#include <cmath>
#include <numbers>

#include "engine/sound/sound_world.h"

namespace gearshift::cabin {

float Noise::next() {
  state_ += 0x9e3779b97f4a7c15u;
  std::uint64_t z = state_;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  z ^= z >> 31;
  return static_cast<float>(static_cast<double>(z >> 11) * 0x1p-52 - 1.0);
}

std::vector<float> looping_noise(std::size_t samples, std::uint64_t seed) {
  Noise noise(seed);
  std::vector<float> out(samples);
  for (float& x : out) x = noise.next();
  return out;
}

// The first pass only computes the filter's state at the end of the loop, from which the second pass starts. The
// remaining error is exp(-2 pi * corner * length / kSoundRate) for a loop of `length` samples. It is far below the
// precision of a float for all loops of this program.
void loop_low_pass(std::vector<float>& samples, double corner) {
  const auto blend = static_cast<float>(1.0 - std::exp(-2.0 * std::numbers::pi * corner / engine::kSoundRate));
  float state = 0.0f;
  for (const float x : samples) state += blend * (x - state);
  for (float& x : samples) x = state += blend * (x - state);
}

void loop_high_pass(std::vector<float>& samples, double corner) {
  std::vector<float> low = samples;
  loop_low_pass(low, corner);
  for (std::size_t n = 0; n < samples.size(); ++n) samples[n] -= low[n];
}

}  // namespace gearshift::cabin
