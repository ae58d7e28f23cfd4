// Seeded noise and filters for loops. A filtered loop repeats without a step between its end and its beginning.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gearshift::cabin {

// Uniform random numbers from -1 (included) to 1 (excluded). Unlike those of the std distributions, they are the same
// on every machine.
class Noise {
 public:
  explicit Noise(std::uint64_t seed) : state_(seed) {}
  float next();

 private:
  std::uint64_t state_;
};

std::vector<float> looping_noise(std::size_t samples, std::uint64_t seed);

// First-order filters, in place. `corner`: corner frequency [Hz] at kSoundRate.
void loop_low_pass(std::vector<float>& samples, double corner);
void loop_high_pass(std::vector<float>& samples, double corner);

}  // namespace gearshift::cabin
