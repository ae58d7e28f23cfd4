// Normally distributed noise that is the same on every machine's standard library for the same seed.
#pragma once

#include <cstdint>
#include <random>

namespace gearshift {

// Box-Muller on std::mt19937_64: the standard fixes that engine's numbers, but not
// std::normal_distribution's.
class GaussianNoise {
 public:
  explicit GaussianNoise(std::uint64_t seed) : engine_(seed) {}

  double next() noexcept;  // mean 0, standard deviation 1. Real-time safe

 private:
  double uniform() noexcept;  // in (0, 1]

  std::mt19937_64 engine_;
};

}  // namespace gearshift
