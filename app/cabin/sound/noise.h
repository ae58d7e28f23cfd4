// Seeded noise, and filters for loops: their output continues from the end into the beginning.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gearshift::cabin {

// Uniform in [-1, 1). The same numbers on every machine, which the distributions of std do not guarantee.
class Noise {
 public:
  explicit Noise(std::uint64_t seed) : state_(seed) {}
  float next();

 private:
  std::uint64_t state_;
};

std::vector<float> looping_noise(std::size_t samples, std::uint64_t seed);

// First order, in place; corner frequency in [Hz] at kSoundRate.
void loop_low_pass(std::vector<float>& samples, double corner);
void loop_high_pass(std::vector<float>& samples, double corner);

}  // namespace gearshift::cabin
