// Noise with a seed, and filters for loops: their output runs on from the end into the beginning.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gearshift {

// Uniform in [-1, 1). The same numbers on every machine, which std's distributions do not promise.
class Noise {
 public:
  explicit Noise(std::uint64_t seed) : state_(seed) {}
  float next();

 private:
  std::uint64_t state_;
};

std::vector<float> looping_noise(std::size_t samples, std::uint64_t seed);

// First order, in place, corner in [Hz] at kSoundRate.
void loop_low_pass(std::vector<float>& samples, double corner);
void loop_high_pass(std::vector<float>& samples, double corner);

}  // namespace gearshift
